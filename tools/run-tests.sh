#!/bin/sh
# `make test`: every check, each under its heading. A failure does not stop the ones after it.
# The last line is `tests: N passed, N failed, N skipped`: the checks of the boundary script, those
# of the C core, testthat's expectations and R CMD check's verdicts, added up.
. "${0%/*}/common.sh"

start=$(date +%s)
passed=0 failed=0 skipped=0
heading() { printf '\n==== %s (after %s s)\n' "$1" $(($(date +%s) - start)); }

# verdict pass|fail|skip TEXT: one check of our own.
verdict() {
  case $1 in
    pass) passed=$((passed + 1)); echo "ok - $2" ;;
    fail) failed=$((failed + 1)); echo "not ok - $2" ;;
    skip) skipped=$((skipped + 1)); echo "skip - $2" ;;
  esac
}

# counted NAME COMMAND...: runs it, shows what it prints, and adds up its closing line
# `NAME: N passed, N failed[, N skipped]`. No such line, or a bad exit with no failure counted, is
# a failure: the script died.
counted() {
  name=$1
  shift
  "$@" < /dev/null > "$work/$name.out" 2>&1
  status=$?
  cat "$work/$name.out"
  counts=$(sed -n "s/^$name: \([0-9]*\) passed, \([0-9]*\) failed\(, \([0-9]*\) skipped\)\{0,1\}\$/\1 \2 \4/p" \
    "$work/$name.out" | tail -n 1)
  # shellcheck disable=SC2086
  set -- $counts
  passed=$((passed + ${1:-0})) failed=$((failed + ${2:-0})) skipped=$((skipped + ${3:-0}))
  if test -z "$counts" || { test $status != 0 && test "$2" = 0; }; then
    verdict fail "$name ended with status $status and no failure counted"
  fi
}

heading "setup"
sh tools/setup.sh test || verdict fail "setup"

heading "boundary"
counted boundary sh tools/check-boundary.sh

heading "C core"
counted core sh tests/core/run.sh

heading "R CMD build and INSTALL"
vignettes=yes
for need in knitr rmarkdown; do
  test -z "$(Rscript tools/setup.R missing $need)" || vignettes=no
done
command -v pandoc > /dev/null 2>&1 || vignettes=no
if test $vignettes = yes; then
  if build_tarball "$work" > "$work/build.out" 2>&1; then
    verdict pass "R CMD build"
  else
    cat "$work/build.out"
    verdict fail "R CMD build"
    vignettes=no
  fi
else
  verdict skip "vignettes: knitr, rmarkdown or pandoc is not here"
fi
# Without its vignettes, so that the checks below still have something to check.
test -n "$tarball" || build_tarball "$work" --no-build-vignettes > "$work/build.out" 2>&1 ||
  { cat "$work/build.out"; verdict fail "R CMD build --no-build-vignettes"; }

mkdir "$work/library"
if test -n "$tarball"; then
  if install_into "$work/library" > "$work/install.out" 2>&1; then
    verdict pass "R CMD INSTALL"
  else
    cat "$work/install.out"
    verdict fail "R CMD INSTALL"
  fi
fi

heading "testthat"
# A copy, so that a new snapshot does not land in the tree. NOT_CRAN: nothing is left out.
mkdir "$work/tests"
cp -R tests/testthat "$work/tests/"
if test -d "$work/library/rotdyn"; then
  counted testthat env NOT_CRAN=true "R_LIBS=$work/library:$R_LIBS" \
    Rscript tools/run-testthat.R "$work/tests/testthat"
else
  verdict fail "testthat: the package is not installed"
fi

heading "R CMD check --as-cran"
# Only what asks another host is switched off:
#   _R_CHECK_CRAN_INCOMING_REMOTE_          compares with CRAN's own package list, follows URLs
#   _R_CHECK_SYSTEM_CLOCK_                  asks a time server whether our clock is right
#   _R_CHECK_XREFS_USE_ALIASES_FROM_CRAN_   fetches the help topics of packages not installed here
check_options="--as-cran --no-manual"
test $vignettes = yes || check_options="$check_options --ignore-vignettes"
force=true
# A suggested package that could not be had was announced by setup; it is no error of ours. But
# with one absent, --as-cran asks CRAN who maintains it, and no switch keeps it from asking.
# shellcheck disable=SC2046
if test -n "$(Rscript tools/setup.R missing $(Rscript tools/setup.R suggests))"; then
  verdict skip "--as-cran: a suggested package is not here, so the check is the plain one"
  force=false
  check_options=${check_options#--as-cran }
fi
if test -n "$tarball"; then
  # shellcheck disable=SC2086
  (cd "$work" && env _R_CHECK_CRAN_INCOMING_REMOTE_=false _R_CHECK_SYSTEM_CLOCK_=false \
    _R_CHECK_XREFS_USE_ALIASES_FROM_CRAN_=false _R_CHECK_FORCE_SUGGESTS_=$force \
    R CMD check $check_options "$tarball" < /dev/null > check.out 2>&1)
  counted check Rscript tools/read-check.R "$work/rotdyn.Rcheck"
else
  verdict fail "R CMD check: there is no tarball"
fi

heading "sum"
echo "tests: $passed passed, $failed failed, $skipped skipped"
test $failed = 0
