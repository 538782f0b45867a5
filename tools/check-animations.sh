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

. tools/web.sh
find_web animations

mkdir "$work/pages" "$work/library"
if test "$ROTDYN_INSTALLED" != yes; then
  sh tools/setup.sh test || exit 1
  { build_tarball "$work" --no-build-vignettes && install_into "$work/library"; } \
    > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
fi
R_LIBS="$work/library:$R_LIBS" Rscript tools/animations.R "$work/pages" || exit 1
CHROMIUM=$chromium WEB=$web PAGES=$work/pages node tools/animations.mjs
