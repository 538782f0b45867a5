#!/bin/sh
# `make manpages`: the manual pages of the command line, made from the verbs' own help by the
# installed package, into DIR (default: man1/ here). Where groff is installed each page is rendered,
# and a warning of it is a failure.
dir=${1:-man1}
case $dir in /*) ;; *) dir=$(pwd)/$dir ;; esac
. "${0%/*}/common.sh"

mkdir -p "$dir" || exit 1
Rscript -e "rotdyn::install_cli('$work/bin')" || exit 1
rotdyn=$work/bin/rotdyn
verbs=$("$rotdyn" help | sed -n '/^Verbs/,/^$/s/^  \([a-z][a-z-]*\) .*/\1/p')
test -n "$verbs" || { echo "manpages: no verbs" >&2; exit 1; }
{
  echo "man --out $work/rotdyn.1"
  for verb in $verbs; do echo "man $verb --out $work/rotdyn-$verb.1"; done
} | "$rotdyn" batch - || exit 1
for page in "$work"/*.1; do
  if command -v groff > /dev/null 2>&1; then
    said=$(groff -man -Tascii -ww -z "$page" 2>&1)
    test -z "$said" || { echo "$said" >&2; exit 1; }
  fi
  cp "$page" "$dir/" || exit 1
done
echo "manpages: $(ls "$dir"/rotdyn*.1 | wc -l | tr -d ' ') pages in $dir"
