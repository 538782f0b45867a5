#!/bin/sh
# The package must install, load, compute and pass or skip its tests with the imported packages
# alone: in R CMD check with its own options, and in a library that contains nothing else.
. "${0%/*}/common.sh"

sh tools/setup.sh test || exit 1
passed=0 failed=0
tally() {
  if test "$1" = 0; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
}

build_tarball "$work" --no-build-vignettes > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }

# _R_CHECK_DEPENDS_ONLY_: examples and tests see the strong dependencies (and testthat) alone;
# _R_CHECK_NO_RECOMMENDED_ hides the packages that come with R but are not base R.
echo "==== R CMD check without the suggested packages"
(cd "$work" && env _R_CHECK_DEPENDS_ONLY_=true _R_CHECK_NO_RECOMMENDED_=true \
  _R_CHECK_FORCE_SUGGESTS_=false R CMD check --no-manual --ignore-vignettes "$tarball" \
  < /dev/null > R-CMD-check.out 2>&1)
Rscript tools/read-check.R "$work/rotdyn.Rcheck"
tally $?

# R_ENVIRON: the site's Renviron may add libraries to R_LIBS_SITE.
echo "==== testthat in a library of imports alone"
mkdir "$work/library"
Rscript tools/link-imports.R "$work/library" || exit 1
R_ENVIRON=/dev/null R_ENVIRON_USER=/dev/null R_LIBS=$work/library
R_LIBS_SITE=$R_LIBS R_LIBS_USER=$R_LIBS
export R_ENVIRON R_ENVIRON_USER R_LIBS R_LIBS_SITE R_LIBS_USER
Rscript tools/link-imports.R "$work/library" --verify || exit 1
if install_into "$work/library" > "$work/log" 2>&1; then
  # A copy, so that a new snapshot does not land in the tree.
  mkdir "$work/tests"
  cp -R tests/testthat tests/testthat.R "$work/tests/"
  (cd "$work/tests" && NOT_CRAN=true Rscript testthat.R)
  tally $?
else
  cat "$work/log"
  tally 1
fi

echo "nosuggests: $passed passed, $failed failed"
test $failed = 0
