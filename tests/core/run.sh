#!/bin/sh
# Tests of the C core, without R.
#
#   tests/core/run.sh              every compiler and standard
#   tests/core/run.sh --valgrind   one build, run under valgrind
#   tests/core/run.sh --figures    writes api/figures.txt anew (api/test_figures.c)
#   tests/core/run.sh --cross CC [EMULATOR]
#                                  one build by a cross compiler, linked statically, and run by the
#                                  emulator of its processor; a sixteenth of the random cases,
#                                  warnings of the tests allowed; CFLAGS count
#
# Each test_*.c below tests/core is a program of its own, linked with all of src/core. The builds
# that run, for the compilers gcc and clang or the one that is installed:
#   the first compiler, C99: the core with -O2, the test programs, whose compilation takes longer
#     than their run, with -O0; a quarter of the random cases
#   the last compiler that has them, its newest standard: address and undefined behaviour
#     sanitizers, -O0, a sixteenth of the random cases
#   with ROTDYN_LONG=yes (`make check-long`): the last compiler, its newest standard, -O2; the
#     sanitizers with all cases
# For the other pairs of compiler and standard the core is compiled for its warnings
# (-fsyntax-only).
#
# A build counts as one check; so does each test (a function with checks) of a build that runs. The
# last line is `core: N passed, N failed, N skipped`. CORE_STDS="c99" narrows the standards.

cd "$(dirname "$0")/../.." || exit 1
# Tests look for reference data beside the repository and skip what needs it where it is absent.
if test -z "$ROTDYN_SHARED" && test -d ../shared; then
  ROTDYN_SHARED=$(cd ../shared && pwd)
  export ROTDYN_SHARED
fi

stds=${CORE_STDS:-"c99 c11 c17 c23"}
warnings="-Wall -Wextra -Wpedantic -Wstrict-prototypes -Wmissing-prototypes -Wconversion -Wshadow"

work=$(mktemp -d "${TMPDIR:-/tmp}/rotdyn-core.XXXXXX") || exit 1
trap 'rm -rf "$work"' 0
trap 'exit 1' HUP INT TERM

# Of a build for another processor: how its programs are linked and run. The test programs are told
# that the core is optimised.
link="" emulator="" optimised=-DROT_TEST_OPTIMISED
if test "$1" = --cross; then link=-static emulator=$3 optimised="" warnings=-w; fi
export optimised

passed=0 failed=0 skipped=0
pass() { passed=$((passed + 1)); }
fail() { failed=$((failed + 1)); }
skip() { skipped=$((skipped + 1)); echo "skip - $1"; }

# GSL's headers count as system headers, so that their warnings are silent. /usr/include is one
# already, and naming it again can hide a compiler's own headers.
if gsl_libs=$(pkg-config --libs gsl 2>/dev/null); then gsl_cflags=$(pkg-config --cflags gsl)
elif gsl_libs=$(gsl-config --libs 2>/dev/null); then gsl_cflags=$(gsl-config --cflags)
else gsl_libs="-lgsl -lgslcblas -lm" gsl_cflags=""
fi
gsl_cflags="${GSL_CFLAGS:-${INCLUDE_DIR:+-I$INCLUDE_DIR} $gsl_cflags}"
gsl_libs="${GSL_LIBS:-${LIB_DIR:+-L$LIB_DIR} $gsl_libs}"
gsl_cflags=$(for flag in $gsl_cflags; do
  case $flag in
    -I/usr/include) ;;
    -I*) printf '%s ' "-isystem ${flag#-I}" ;;
    *) printf '%s ' "$flag" ;;
  esac
done)

core=$(find src/core -name "*.c" | LC_ALL=C sort)
tests=$(find tests/core -name "test_*.c" | LC_ALL=C sort)
# Objects and programs by their paths: two folders may have files of one name.
names=$(echo "$tests" | sed 's|^tests/core/||; s|[.]c$||; s|/|-|g')
if test -z "$core" || test -z "$tests"; then
  echo "there is no file in src/core, or no test in tests/core"
  echo "core: 0 passed, 1 failed, 0 skipped"
  exit 1
fi

# accepts COMPILER FLAGS...: does it compile, link and run an empty program so?
accepts() {
  echo 'int main(void) { return 0; }' > "$work/empty.c"
  "$@" $link "$work/empty.c" -o "$work/empty" > /dev/null 2>&1 &&
    $emulator "$work/empty" > /dev/null 2>&1
}

# build DIR COMPILER FLAGS...: compiles and links into DIR, several files at a time. DIR/log holds
# what the compiler prints. Without contraction of a * b + c, as configure has it.
build() {
  dir=$1
  shift
  mkdir -p "$dir"
  contract=-ffp-contract=off
  accepts "$1" -Werror $contract || contract=
  for file in $core $tests; do echo "$file"; done |
    xargs -P "$jobs" -I{} sh -c 'file=$1; dir=$2; shift 2
      case " $* $file" in *" -O2 "*tests/*) set -- "$@" -O0 $optimised ;; esac
      name=${file#tests/core/} name=$(echo "${name%.c}" | tr / -)
      "$@" -Isrc/core -Itests/core -c "$file" -o "$dir/$name.o" > "$dir/$name.log" 2>&1' \
      build {} "$dir" "$@" $contract $warnings -Werror $gsl_cflags &&
    ${AR:-ar} cr "$dir/librot.a" "$dir"/src-core-*.o &&
    for name in $names; do echo "$name"; done |
    xargs -P "$jobs" -I{} sh -c 'name=$1; dir=$2; libs=$3; shift 3
      "$@" "$dir/$name.o" "$dir/librot.a" $libs -o "$dir/$name" >> "$dir/$name.log" 2>&1' \
      link {} "$dir" "$gsl_libs -lm -lpthread $link" "$@"
  status=$?
  cat "$dir"/*.log > "$dir/log"
  return $status
}

# run DIR [WRAPPER...]: runs the programs, several at a time, and adds up their closing lines. A
# program that dies counts as a failure, each line `skip - why` as a skip.
run() {
  dir=$1
  shift
  for name in $names; do echo "$name"; done |
    xargs -P "$jobs" -I{} sh -c 'name=$1; dir=$2; shift 2
      "$@" "$dir/$name" > "$dir/$name.out" 2>&1; echo $? > "$dir/$name.status"' run {} "$dir" "$@"
  for name in $names; do
    status=$(cat "$dir/$name.status")
    line=$(sed -n 's/^core [^:]*: \([0-9]*\) passed, \([0-9]*\) failed$/\1 \2/p' "$dir/$name.out" |
      tail -n 1)
    p=${line%% *} f=${line##* }
    skipped=$((skipped + $(grep -c '^skip - ' "$dir/$name.out")))
    passed=$((passed + ${p:-0})) failed=$((failed + ${f:-0}))
    if test "$status" = 0 && test -n "$line"; then
      echo "  $name: $p passed, $f failed"
      grep '^skip - ' "$dir/$name.out" | sed 's/^/  /'
    else
      test "${f:-0}" != 0 || fail
      sed 's/^/  /' "$dir/$name.out"
      echo "  $name: exit status $status"
    fi
  done
}

# check LABEL COMPILER FLAGS...: builds, counts that as one check, runs.
check() {
  label=$1
  shift
  dir="$work/$(echo "$label" | tr ' ,' '__')"
  if build "$dir" "$@"; then
    echo "ok - builds: $label"
    pass
    # New memory holds garbage rather than zeros, so that a read of unset memory shows.
    run "$dir" env MALLOC_PERTURB_=165
  else
    echo "not ok - builds: $label"
    sed 's/^/  /' "$dir/log"
    fail
  fi
  rm -rf "$dir"
}

# warn COMPILER STANDARD: compiles for the warnings alone.
warn() {
  if (for file in $core; do echo "$file"; done | xargs -P "$jobs" -n 8 \
    "$1" -std="$2" -fsyntax-only -Isrc/core -Itests/core $warnings -Werror $gsl_cflags) \
    > "$work/log" 2>&1; then
    echo "ok - compiles: $1 $2"
    pass
  else
    echo "not ok - compiles: $1 $2"
    sed 's/^/  /' "$work/log"
    fail
  fi
}

# header COMPILER STANDARD: the C interface alone, as a client includes it.
header() {
  case $2 in *++*) file="$work/header.cc" ;; *) file="$work/header.c" ;; esac
  printf '#include "rotdyn.h"\nrotdyn_report here = ROTDYN_INIT(rotdyn_report);\n' > "$file"
  if "$1" -std="$2" -fsyntax-only -Iinst/include -Wall -Wextra -Wpedantic -Wconversion -Wshadow \
    -Werror "$file" > "$work/log" 2>&1; then
    echo "ok - inst/include/rotdyn.h: $1 $2"
    pass
  else
    echo "not ok - inst/include/rotdyn.h: $1 $2"
    sed 's/^/  /' "$work/log"
    fail
  fi
}

# fast COMPILER: flags of fast mathematics that the compiler announces by a macro are refused by
# ground/ieee.h, which every file sees (tools/check-boundary.sh).
fast() {
  for flag in -Ofast -ffast-math -ffinite-math-only -funsafe-math-optimizations; do
    echo | "$1" $flag -dM -E - 2> /dev/null | grep -Eq \
      '__(FAST_MATH|FINITE_MATH_ONLY|ASSOCIATIVE_MATH|RECIPROCAL_MATH)__ 1' || continue
    if ! "$1" $flag -Isrc/core -fsyntax-only src/core/ground/status.c > "$work/log" 2>&1 &&
      grep -q "needs IEEE 754" "$work/log"; then
      echo "ok - refuses $flag: $1"
      pass
    else
      echo "not ok - refuses $flag: $1"
      fail
    fi
  done
}

jobs=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)

if test "$1" = --valgrind; then
  dir="$work/valgrind"
  if build "$dir" ${CC:-cc} -std=c99 -O1 -g; then
    run "$dir" valgrind -q --leak-check=full \
      --show-leak-kinds=definite,indirect --errors-for-leak-kinds=definite,indirect \
      --error-exitcode=99
  else
    cat "$dir/log"
    fail
  fi
elif test "$1" = --figures; then
  names=api-test_figures tests=tests/core/api/test_figures.c dir="$work/figures"
  if build "$dir" ${CC:-cc} -std=c99 -O2; then
    run "$dir" env ROTDYN_FIGURES=write
  else
    cat "$dir/log"
    fail
  fi
elif test "$1" = --cross; then
  dir="$work/cross"
  # shellcheck disable=SC2086
  if build "$dir" "$2" -std=c99 -O2 $CFLAGS; then
    echo "ok - builds: $2 c99 -O2"
    pass
    # shellcheck disable=SC2086
    run "$dir" env MALLOC_PERTURB_=165 ROTDYN_FIGURES=other $emulator
  else
    echo "not ok - builds: $2"
    cat "$dir/log"
    fail
  fi
else
  compilers=""
  for cc in gcc clang; do
    if command -v $cc > /dev/null 2>&1; then compilers="$compilers $cc"
    else skip "$cc is not installed"; fi
  done
  first=${compilers# } first=${first%% *} last=${compilers##* } sanitizer=""
  test -n "$compilers" || fail
  for cc in $compilers; do
    # c23 was called c2x, and c17 c18, before they were finished.
    known=""
    for std in $stds; do
      case $std in c17) spellings="c17 c18" ;; c23) spellings="c23 c2x" ;; *) spellings=$std ;; esac
      one=""
      for spelling in $spellings; do
        if accepts $cc -std="$spelling"; then one=$spelling; break; fi
      done
      if test -n "$one"; then known="$known $one"; else skip "$cc does not know $std"; fi
    done
    if accepts $cc -fsanitize=address,undefined; then sanitizer=$cc newest=${known##* }; fi
    for std in $known; do
      if { test $cc = "$first" && test "$std" = c99; } ||
        { test -n "$ROTDYN_LONG" && test $cc = "$last" && test "$std" = "${known##* }"; }; then
        check "$cc $std -O2" $cc -std="$std" -O2
      elif test $cc = "$last" && test "$sanitizer $std" = "$cc $newest"; then
        : # built below, with the sanitizers
      else
        warn $cc "$std"
      fi
    done
    for std in $known; do header $cc "$std"; done
    case $cc in gcc) cxx=g++ ;; *) cxx=$cc++ ;; esac
    for std in c++11 c++20; do
      if ! command -v $cxx > /dev/null 2>&1; then skip "$cxx is not installed"; break; fi
      header $cxx $std
    done
    fast $cc
  done
  if test -n "$sanitizer"; then
    check "$sanitizer $newest address,undefined" $sanitizer -std="$newest" -O0 -g1 \
      -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all
  else
    skip "no compiler has the sanitizers"
  fi
fi

echo "core: $passed passed, $failed failed, $skipped skipped"
test $failed = 0
