#!/bin/sh
# Animations in a browser: five pages driven by the keyboard in headless Chromium, the last frame
# against the last row, axe-core's rules of accessibility.
#
#   tools/check-animations.sh
#
# Chromium comes from apt-get where it is missing, if that exists and the user is root; npm's
# packages playwright-core and axe-core go to a folder outside the repository (ROTDYN_WEB, or one in
# the folder of temporary files). Without Chromium or npm the check is skipped: exit 0 with a note.
# ROTDYN_INSTALLED=yes takes the package that R finds instead of building this one.

. "${0%/*}/common.sh"

skip() { echo "animations: skipped, $*"; exit 0; }

find_chromium() { command -v chromium || command -v chromium-browser || command -v google-chrome; }

chromium=$(find_chromium)
if test -z "$chromium" && command -v apt-get > /dev/null 2>&1 && test "$(id -u)" = 0; then
  apt-get update -qq < /dev/null || true
  # A second time: an installation that lost an archive goes on.
  for time in 1 2; do
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends chromium \
      < /dev/null > /dev/null 2>&1 && break
  done
  chromium=$(find_chromium)
fi
test -n "$chromium" || skip "Chromium is not installed"
command -v node > /dev/null 2>&1 || skip "node is not installed"

web=${ROTDYN_WEB:-${TMPDIR:-/tmp}/rotdyn-web}
mkdir -p "$web" || exit 1
if ! test -d "$web/node_modules/playwright-core" || ! test -d "$web/node_modules/axe-core"; then
  command -v npm > /dev/null 2>&1 || skip "npm is not installed"
  (cd "$web" && npm install --no-save --no-audit --no-fund playwright-core axe-core) \
    > "$web/npm.log" 2>&1 || { tail -n 5 "$web/npm.log"; skip "npm installed no packages"; }
fi

mkdir "$work/pages" "$work/library"
if test "$ROTDYN_INSTALLED" != yes; then
  sh tools/setup.sh test || exit 1
  { build_tarball "$work" --no-build-vignettes && install_into "$work/library"; } \
    > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
fi
R_LIBS="$work/library:$R_LIBS" Rscript tools/animations.R "$work/pages" || exit 1
CHROMIUM=$chromium WEB=$web PAGES=$work/pages node tools/animations.mjs
