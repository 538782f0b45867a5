#!/bin/sh
# Every scene and body that the tests make comes back from text and computes the same bits.
#
#   tools/check-scenes.sh [FILTER]     of the names of test files
. "${0%/*}/common.sh"

mkdir "$work/library"
{ build_tarball "$work" --no-build-vignettes && install_into "$work/library"; } \
  > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
# A copy, so that no snapshot of a traced function lands in the tree.
mkdir "$work/tests"
cp -R tests/testthat "$work/tests/"
R_LIBS="$work/library:$R_LIBS" NOT_CRAN=true \
  Rscript tools/check-scenes.R "$work/tests/testthat" "$@"
