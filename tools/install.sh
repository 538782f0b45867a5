#!/bin/sh
# Installs the package from this tree into the first R library that can be written, with its lessons
# where knitr, rmarkdown and pandoc are there to make them.
#
#   tools/install.sh [--no-build-vignettes]
. "${0%/*}/common.sh"

library=$(Rscript tools/setup.R library) || exit 1
lessons=yes
if test "$1" = --no-build-vignettes; then
  lessons=no
elif test -n "$(Rscript tools/setup.R missing knitr rmarkdown)" ||
  ! Rscript -e 'quit(status = !rmarkdown::pandoc_available("1.14"))'; then
  lessons=no
  echo "install: without the lessons, which need knitr, rmarkdown and pandoc"
fi
options=""
test $lessons = yes || options=--no-build-vignettes
# shellcheck disable=SC2086
{ build_tarball "$work" $options && install_into "$library"; } > "$work/log" 2>&1 ||
  { cat "$work/log"; echo "install: failed"; exit 1; }
echo "install: $(basename "$tarball" .tar.gz) is in $library"
test $lessons = no ||
  echo "install: in R, vignette(\"kinematics\", package = \"rotdyn\") opens lesson 1"
