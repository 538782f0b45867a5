#!/bin/sh
# The lab: the stand-ins for GSL beside GSL, the core as WebAssembly beside the native one, then the
# page in Chromium (skipped without it). SCENES=60: random scenes of each constructor, SEED=;
# MUTANTS=20000: damaged scenes, LINKS=400: damaged links of the page; LAB_R=yes: by the installed
# package the R code of each scene is run, a document rendered, and the motions of the help pages'
# examples are collected for both cores. Closes with `lab: N passed, ...`.
# SANITIZED=yes: the native program under the sanitizers of addresses and undefined behaviour.
# LAB_WASM, LAB_NATIVE: what is made already.

cd "$(dirname "$0")/.." || exit 1
. tools/web.sh
find_web lab

work=$(mktemp -d "${TMPDIR:-/tmp}/rotdyn-check-lab.XXXXXX") || exit 1
trap 'rm -rf "$work"' 0
trap 'exit 1' HUP INT TERM
fail() { echo "lab: $*" >&2; exit 1; }

CC=${CC:-cc}
sanitizers=""
test "$SANITIZED" != yes ||
  sanitizers="-g -fsanitize=address,undefined -fno-sanitize-recover=all"
flags="-std=c99 -O2 -ffp-contract=off $sanitizers"
gsl_flags=$(pkg-config --cflags gsl 2> /dev/null)
gsl_libs=$(pkg-config --libs gsl 2> /dev/null || echo "-lgsl -lgslcblas -lm")
# shellcheck disable=SC2086
$CC $flags -Iweb/core/few -c web/tests/gsl_few_names.c -o "$work/names.o" &&
  $CC $flags $gsl_flags web/tests/gsl_few.c "$work/names.o" $gsl_libs -o "$work/gsl_few" ||
  fail "the test of the stand-ins does not compile"

# The same entries, native and with GSL: a program that answers lines.
if test -z "$LAB_NATIVE"; then
  LAB_NATIVE=$work/native
  CFLAGS=$sanitizers sh tools/lab-native.sh "$LAB_NATIVE" || exit 1
fi

if test -n "$LAB_WASM"; then cp "$LAB_WASM" "$work/lab.wasm"
else sh tools/lab.sh wasm "$work/lab.wasm" || exit 1; fi

LAB_EXAMPLES=""
if test -n "$LAB_R"; then
  LAB_EXAMPLES=$work/examples
  Rscript web/tests/examples.R "$LAB_EXAMPLES" > "$work/said" 2>&1 ||
    { cat "$work/said"; fail "the examples of the help pages do not run"; }
fi

CHROMIUM=$chromium WEB=$web LAB_EXAMPLES=$LAB_EXAMPLES LAB_FEW=$work/gsl_few \
  LAB_NATIVE=$LAB_NATIVE LAB_WASM=$work/lab.wasm \
  node --test --test-concurrency=1 --test-reporter=tap web/tests/*.test.mjs > "$work/said" 2>&1
grep -vE '^ *(---|\.\.\.|duration_ms|type:)' "$work/said"
count() { sed -n "s/^# $1 \([0-9]*\)$/\1/p" "$work/said" | tail -n 1; }
failed=$(count fail)
echo "lab: $(count pass) passed, ${failed:-1} failed, $(count skipped) skipped"
test "${failed:-1}" = 0
