#!/bin/sh
# `make check-cran`: what CRAN's machines do with the tarball: R CMD check --as-cran without
# NOT_CRAN and with at most two threads. Prints the verdicts, the processor time by part, the
# licences of all files, and what a maintainer must fill in. What asks another host is
# switched off, as in tools/run-tests.sh. VIGNETTES=no leaves the vignettes out. The last line is
# `cran: N passed, N failed, N skipped`.
. "${0%/*}/common.sh"

passed=0 failed=0 skipped=0
verdict() {
  case $1 in
    pass) passed=$((passed + 1)); echo "ok - $2" ;;
    fail) failed=$((failed + 1)); echo "not ok - $2" ;;
    skip) skipped=$((skipped + 1)); echo "skip - $2" ;;
  esac
}

options="--as-cran --no-manual"
no_vignettes=""
if test "$VIGNETTES" = no; then
  no_vignettes=--no-build-vignettes options="$options --ignore-vignettes"
fi
build_tarball "$work" $no_vignettes > "$work/log" 2>&1 ||
  { tail -n 30 "$work/log"; verdict fail "R CMD build"; exit 1; }
ls -l "$tarball" | awk '{ printf "  tarball: %.2f MB\n", $5 / 1e6 }'

if Rscript tools/check-licences.R "$tarball"; then verdict pass "every file has a licence line"
else verdict fail "every file has a licence line"; fi

if command -v aspell > /dev/null 2>&1; then
  if Rscript tools/check-spelling.R; then verdict pass "spelling"
  else verdict fail "spelling"; fi
else
  verdict skip "spelling: aspell is not installed"
fi

# shellcheck disable=SC2086
(cd "$work" && env -u NOT_CRAN -u ROTDYN_SHARED -u ROTDYN_ROOT OMP_THREAD_LIMIT=2 \
  _R_CHECK_LIMIT_CORES_=true _R_CHECK_TIMINGS_=0 _R_CHECK_CRAN_INCOMING_REMOTE_=false \
  _R_CHECK_SYSTEM_CLOCK_=false _R_CHECK_XREFS_USE_ALIASES_FROM_CRAN_=false \
  R CMD check $options "$tarball" < /dev/null > check.out 2>&1)
if Rscript tools/read-check.R "$work/rotdyn.Rcheck"; then verdict pass "R CMD check --as-cran"
else verdict fail "R CMD check --as-cran"; fi

if Rscript tools/check-times.R "$work/rotdyn.Rcheck" 300; then
  verdict pass "at most 300 s of processor time"
else
  verdict fail "at most 300 s of processor time"
fi

# The one line of DESCRIPTION that is not ours to write.
if grep -q '"rotdyn authors".*email = "rotdyn@example.org"' DESCRIPTION; then
  verdict skip "the maintainer: fill in the line with rotdyn@example.org in DESCRIPTION"
else
  verdict pass "the maintainer is filled in"
fi
echo "cran: $passed passed, $failed failed, $skipped skipped"
test $failed = 0
