#!/bin/sh
# `make deb`: builds the Debian packages of packaging/debian from the files of this folder, into DIR
# (default: debian-packages/ here), and checks them by lintian: an error of it is a failure.
dir=${1:-debian-packages}
case $dir in /*) ;; *) dir=$(pwd)/$dir ;; esac
. "${0%/*}/common.sh"

for program in dpkg-buildpackage dh lintian; do
  command -v $program > /dev/null 2>&1 || {
    echo "skip - $program is not here: apt-get install dpkg-dev debhelper lintian"
    exit
  }
done
version=$(sed -n 's/^Version: //p' DESCRIPTION)
source=$work/rotdyn-$version
mkdir "$source" || exit 1
tar cf - --exclude=.git --exclude='*.o' --exclude='*.so' --exclude=./library . |
  (cd "$source" && tar xf - && ./cleanup && rm -rf debian-packages) || exit 1
(cd "$work" && tar czf "rotdyn_$version.orig.tar.gz" "rotdyn-$version") || exit 1
cp -R packaging/debian "$source/debian" || exit 1
(cd "$source" && DEB_BUILD_OPTIONS="parallel=$cores nocheck" dpkg-buildpackage -us -uc) \
  > "$work/log" 2>&1 || { tail -n 60 "$work/log"; exit 1; }
mkdir -p "$dir"
cp "$work"/*.deb "$work"/*.changes "$work"/*.dsc "$work"/*.tar.* "$dir/" || exit 1
(cd "$work" && lintian --allow-root --tag-display-limit 0 ./*.changes) > "$work/lintian" 2>&1
cat "$work/lintian"
echo "deb: $(ls "$dir"/*.deb | wc -l | tr -d ' ') packages in $dir," \
  "lintian: $(grep -c '^E:' "$work/lintian") errors, $(grep -c '^W:' "$work/lintian") warnings"
! grep -q '^E:' "$work/lintian"
