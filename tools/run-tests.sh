#!/bin/sh
# `make test`: every check, each under its heading. A failure does not stop the later ones.
#
# The tests of the C core run beside the checks of the R package, at a lower priority. R CMD build
# builds the vignettes and R CMD check runs the examples and the tests, each once. No verdict
# depends on elapsed time. ROTDYN_LONG=yes (`make check-long`) runs what is exhaustive.
#
# The last line is `tests: N passed, N failed, N skipped`: the rules of the boundary script, the
# builds and tests of the C core, testthat's blocks and the verdicts of R CMD check, added up.
. "${0%/*}/common.sh"

start=$(date +%s)
passed=0 failed=0 skipped=0
# The processor time (user, system) is that of the stages so far; the C core counts from its end.
heading() {
  times > "$work/times"
  printf '\n==== %s (after %s s; processor time %s)\n' "$1" $(($(date +%s) - start)) \
    "$(sed -n '2s/ /, /p' "$work/times")"
}

# verdict pass|fail|skip TEXT: one check of our own.
verdict() {
  case $1 in
    pass) passed=$((passed + 1)); echo "ok - $2" ;;
    fail) failed=$((failed + 1)); echo "not ok - $2" | tee -a "$work/failures" ;;
    skip) skipped=$((skipped + 1)); echo "skip - $2" ;;
  esac
}

# counted NAME STATUS: shows $work/NAME.out and adds up its closing line
# `NAME: N passed, N failed[, N skipped]`. Without that line, or where the script that wrote it
# ended with a STATUS other than 0 and no failure counted, the script itself has failed.
counted() {
  name=$1 status=$2
  cat "$work/$name.out"
  counts=$(sed -n \
    "s/^$name: \([0-9]*\) passed, \([0-9]*\) failed\(, \([0-9]*\) skipped\)\{0,1\}\$/\1 \2 \4/p" \
    "$work/$name.out" | tail -n 1)
  # shellcheck disable=SC2086
  set -- $counts
  passed=$((passed + ${1:-0})) failed=$((failed + ${2:-0})) skipped=$((skipped + ${3:-0}))
  if test "${2:-0}" != 0; then
    grep -Ev '^ *ok|passed, 0 failed' "$work/$name.out" | tail -n 60 >> "$work/failures"
  fi
  if test -z "$counts" || { test "$status" != 0 && test "$2" = 0; }; then
    verdict fail "$name ended with status $status and no failure counted"
  fi
}

heading "setup"
sh tools/setup.sh test || verdict fail "setup"

heading "boundary"
sh tools/check-boundary.sh < /dev/null > "$work/boundary.out" 2>&1
counted boundary $?

if sh tools/check-constraint-cost.sh; then
  verdict pass "tools/check-constraint-cost.sh"
else
  verdict fail "tools/check-constraint-cost.sh"
fi

nice -n 5 sh tests/core/run.sh < /dev/null > "$work/core.out" 2>&1 &
core=$!
trap 'kill $core 2> /dev/null; rm -rf "$work"' 0

heading "layout of the C code"
# Other versions lay out some lines in another way.
case $(clang-format --version 2> /dev/null) in
  *" version 14."*)
    if find src tests/core web -name '*.[ch]' -exec clang-format --dry-run -Werror {} +; then
      verdict pass "clang-format"
    else
      verdict fail "clang-format: run make format"
    fi ;;
  *) verdict skip "clang-format 14 is not here" ;;
esac

# R CMD build installs the package for the vignettes, R CMD check installs it once more: what the
# first compiled the second takes, with the compiler's words, where the command, the file and all
# headers are the same. The library has no debug information (configure), so none is made.
mkdir "$work/objects"
cat > "$work/compile" << 'COMPILE'
# compile STORE COMPILER ARGS...
store=$1 source="" object="" before=""
shift
for word in "$@"; do
  case $before in -c) source=$word ;; -o) object=$word ;; esac
  before=$word
done
test -f "$source" && test -n "$object" || exec "$@"
# Each installation has a folder of its own, of which the headers are read once.
headers=$store/$(echo "$PWD" | tr / -)
if test ! -f "$headers"; then
  find . -name '*.h' | LC_ALL=C sort | xargs cat | cksum > "$headers.$$"
  mv "$headers.$$" "$headers"
fi
key=$({ echo "$*"; cat "$headers" "$source"; } | cksum)
kept="$store/$(echo "$source" | tr / -)-${key% *}"
if test -f "$kept.o"; then
  cat "$kept.said" >&2
  exec cp "$kept.o" "$object"
fi
"$@" 2> "$kept.said"
status=$?
cat "$kept.said" >&2
test $status != 0 || { cp "$object" "$kept.part" && mv "$kept.part" "$kept.o"; }
exit $status
COMPILE
own=${R_MAKEVARS_USER:-$HOME/.R/Makevars}
test ! -f "$own" || cat "$own" > "$work/Makevars"
cat >> "$work/Makevars" << MAKEVARS
CC = sh $work/compile $work/objects $(R CMD config CC)
CFLAGS = $(R CMD config CFLAGS | sed 's/^-g //; s/ -g / /')
MAKEVARS
R_MAKEVARS_USER=$work/Makevars
export R_MAKEVARS_USER

heading "R CMD build"
vignettes=yes
for need in knitr rmarkdown; do
  test -z "$(Rscript tools/setup.R missing $need)" || vignettes=no
done
command -v pandoc > /dev/null 2>&1 || vignettes=no
if test $vignettes = yes; then
  # Few of the functions run there, so they are compiled to byte code as they are called.
  if (R_COMPILE_PKGS=0 && export R_COMPILE_PKGS && build_tarball "$work") \
    > "$work/build.out" 2>&1 && tarball=$(ls "$work"/rotdyn_*.tar.gz); then
    verdict pass "R CMD build"
  else
    cat "$work/build.out"
    verdict fail "R CMD build"
    vignettes=no
  fi
else
  verdict skip "vignettes: knitr, rmarkdown or pandoc is not installed"
fi
# Without vignettes, so that the checks below have a tarball.
test -n "$tarball" || build_tarball "$work" --no-build-vignettes > "$work/build.out" 2>&1 ||
  { cat "$work/build.out"; verdict fail "R CMD build --no-build-vignettes"; }

if test -n "$tarball"; then
  if Rscript tools/check-licences.R "$tarball" > "$work/licences.out" 2>&1; then
    verdict pass "every file of the tarball has a licence line"
  else
    cat "$work/licences.out"
    verdict fail "every file of the tarball has a licence line"
  fi
fi

heading "R CMD check --as-cran"
# What asks another host is switched off:
#   _R_CHECK_CRAN_INCOMING_REMOTE_          compares with CRAN's own package list, follows URLs
#   _R_CHECK_SYSTEM_CLOCK_                  asks a time server whether our clock is right
#   _R_CHECK_XREFS_USE_ALIASES_FROM_CRAN_   fetches the help topics of packages not installed here
# No example is in \donttest{}: a check as CRAN's would run all of them twice.
check_options="--as-cran --no-manual --no-vignettes"
test $vignettes = yes || check_options="$check_options --ignore-vignettes"
force=true
# Setup has announced a suggested package that is not available; it is not an error. But --as-cran
# then asks CRAN for its maintainer, and no option prevents that.
# shellcheck disable=SC2046
if test -n "$(Rscript tools/setup.R missing $(Rscript tools/setup.R suggests))"; then
  verdict skip "--as-cran: a suggested package is not installed, so the plain check runs"
  force=false
  check_options=${check_options#--as-cran }
fi
if test -n "$tarball"; then
  # NOT_CRAN: no test is left out. TESTTHAT_PARALLEL: several files of tests at a time.
  # _R_CHECK_LENGTH_1_LOGIC2_: && and || of vectors are errors, as in R 4.3.
  # shellcheck disable=SC2086
  (cd "$work" && env NOT_CRAN=true TESTTHAT_PARALLEL=true TESTTHAT_CPUS="$cores" \
    MAKEFLAGS="-j$cores" _R_CHECK_LENGTH_1_LOGIC2_=true _R_CHECK_LENGTH_1_CONDITION_=true \
    _R_CHECK_CRAN_INCOMING_REMOTE_=false _R_CHECK_SYSTEM_CLOCK_=false \
    _R_CHECK_XREFS_USE_ALIASES_FROM_CRAN_=false _R_CHECK_FORCE_SUGGESTS_=$force \
    R CMD check $check_options "$tarball" < /dev/null > R-CMD-check.out 2>&1)
  Rscript tools/read-check.R "$work/rotdyn.Rcheck" > "$work/check.out" 2>&1
  counted check $?

  heading "testthat, in R CMD check"
  grep -h '^testthat: ' "$work"/rotdyn.Rcheck/tests/testthat.Rout* > "$work/testthat.out" 2>&1
  counted testthat $?
else
  verdict fail "R CMD check: there is no tarball"
fi

if test -d "$work/rotdyn.Rcheck/rotdyn"; then
  heading "another locale, one thread"
  # In Turkish the small letter of I is not i. Without the locale the rest is still checked.
  locale=$LC_ALL
  case $(locale -a 2> /dev/null) in
    *tr_TR.utf8*) locale=tr_TR.UTF-8 ;;
    *) verdict skip "the locale tr_TR.UTF-8 is not installed" ;;
  esac
  cp -R tests "$work/tests"
  for topic in check columns read-links read-ply shapes spin-up-table units; do
    if env LC_ALL="$locale" OMP_THREAD_LIMIT=1 NOT_CRAN=true \
      R_LIBS="$work/rotdyn.Rcheck:$R_LIBS" Rscript -e "library(testthat); library(rotdyn)
        test_file('$work/tests/testthat/test-$topic.R', package = 'rotdyn',
          load_package = 'installed', reporter = 'check', stop_on_failure = TRUE)" \
      > "$work/locale.out" 2>&1; then
      verdict pass "test-$topic.R under $locale"
    else
      cat "$work/locale.out"
      verdict fail "test-$topic.R under $locale"
    fi
  done

  heading "demo"
  # The main job as `make demo` runs it, with its pictures in demo-output/.
  if R_LIBS="$work/rotdyn.Rcheck:$R_LIBS" Rscript tools/demo.R > "$work/demo.out" 2>&1; then
    verdict pass "tools/demo.R"
  else
    tail -n 20 "$work/demo.out"
    verdict fail "tools/demo.R"
  fi

  heading "fuzz"
  # The calls of one seed; make check-fuzz has others.
  R_LIBS="$work/rotdyn.Rcheck:$R_LIBS" Rscript tools/fuzz.R calls 300 7 > "$work/fuzz.out" 2>&1
  counted fuzz $?
fi

heading "C core"
wait $core
counted core $?
trap 'rm -rf "$work"' 0

heading "sum"
if test -s "$work/failures"; then
  echo "what failed, once more:"
  cat "$work/failures"
fi
times > "$work/times"
sed -n '2s/^/processor time (user, system): /p' "$work/times"
echo "tests: $passed passed, $failed failed, $skipped skipped"
test $failed = 0
