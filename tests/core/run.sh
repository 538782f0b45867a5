#!/bin/sh
# Tests of the C core, with no R in sight.
#
#   tests/core/run.sh              every compiler and standard
#   tests/core/run.sh --valgrind   one build, run under valgrind
#
# Each tests/core/test_*.c is a program of its own, linked with all of src/rot_*.c. For gcc and
# clang, whichever are here:
#   c99 and the newest standard that the compiler knows: built with -O2 and run
#   the standards between: compiled for their warnings alone
#   address and undefined behaviour sanitizers: built with -O1 and run
# Each build counts as one check; each check in the programs counts. The last line is
# `core: N passed, N failed, N skipped`. CORE_STDS="c99" narrows the standards.

cd "$(dirname "$0")/../.." || exit 1
# Where the tests look for reference data beside the repository; they skip it if it is not there.
if test -z "$ROTDYN_SHARED" && test -d ../shared; then
  ROTDYN_SHARED=$(cd ../shared && pwd)
  export ROTDYN_SHARED
fi

stds=${CORE_STDS:-"c99 c11 c17 c23"}
warnings="-Wall -Wextra -Wpedantic -Wstrict-prototypes -Wmissing-prototypes -Wconversion -Wshadow"

work=$(mktemp -d "${TMPDIR:-/tmp}/rotdyn-core.XXXXXX") || exit 1
trap 'rm -rf "$work"' 0
trap 'exit 1' HUP INT TERM

passed=0 failed=0 skipped=0
pass() { passed=$((passed + 1)); }
fail() { failed=$((failed + 1)); }
skip() { skipped=$((skipped + 1)); echo "skip - $1"; }

# GSL's warnings are not ours: its headers count as system headers. /usr/include is one already,
# and naming it again can hide a compiler's own headers.
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

core=$(ls src/rot_*.c 2>/dev/null)
tests=$(ls tests/core/test_*.c 2>/dev/null)
if test -z "$core" || test -z "$tests"; then
  echo "there is no src/rot_*.c, or no tests/core/test_*.c"
  echo "core: 0 passed, 1 failed, 0 skipped"
  exit 1
fi

# accepts COMPILER FLAGS...: does it compile, link and run an empty program so?
accepts() {
  echo 'int main(void) { return 0; }' > "$work/empty.c"
  "$@" "$work/empty.c" -o "$work/empty" > /dev/null 2>&1 && "$work/empty" > /dev/null 2>&1
}

# build DIR COMPILER FLAGS...: everything, side by side, into DIR. What the compiler says is in
# DIR/log; programs that could be linked are there.
build() {
  dir=$1
  shift
  mkdir -p "$dir"
  echo "$*" > "$dir/command"
  for file in $core $tests; do echo "$file"; done |
    xargs -P "$jobs" -I{} sh -c 'file=$1; dir=$2; shift 2
      name=$(basename "$file" .c)
      "$@" -Isrc -Itests/core -c "$file" -o "$dir/$name.o" > "$dir/$name.log" 2>&1' \
      build {} "$dir" "$@" $warnings -Werror $gsl_cflags
  status=$?
  cat "$dir"/*.log > "$dir/log"
  test $status = 0 || return 1
  for file in $tests; do
    name=$(basename "$file" .c)
    "$@" "$dir/$name.o" "$dir"/rot_*.o $gsl_libs -lm -o "$dir/$name" >> "$dir/log" 2>&1 ||
      return 1
  done
}

# run DIR [WRAPPER...]: each program; its closing line is counted, its death is a failure,
# each line `skip - why` that it prints is a skip.
run() {
  dir=$1
  shift
  for file in $tests; do
    name=$(basename "$file" .c)
    "$@" "$dir/$name" > "$dir/$name.out" 2>&1
    status=$?
    line=$(sed -n 's/^core [^:]*: \([0-9]*\) passed, \([0-9]*\) failed$/\1 \2/p' "$dir/$name.out" |
      tail -n 1)
    p=${line%% *} f=${line##* }
    skipped=$((skipped + $(grep -c '^skip - ' "$dir/$name.out")))
    passed=$((passed + ${p:-0})) failed=$((failed + ${f:-0}))
    if test $status = 0 && test -n "$line"; then
      echo "  $name: $p passed, $f failed"
      grep '^skip - ' "$dir/$name.out" | sed 's/^/  /'
    else
      test "${f:-0}" != 0 || fail
      sed 's/^/  /' "$dir/$name.out"
      echo "  $name: exit status $status"
    fi
  done
}

# check LABEL COMPILER FLAGS...: build, count that as one, run.
check() {
  label=$1
  shift
  dir="$work/$(echo "$label" | tr ' ,' '__')"
  if build "$dir" "$@"; then
    echo "ok - builds: $label"
    pass
    # Fresh memory holds garbage rather than zeros, so that reading it unset shows.
    run "$dir" env MALLOC_PERTURB_=165
  else
    echo "not ok - builds: $label"
    sed 's/^/  /' "$dir/log"
    fail
  fi
}

jobs=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)

if test "$1" = --valgrind; then
  dir="$work/valgrind"
  if build "$dir" ${CC:-cc} -std=c99 -O1 -g; then
    run "$dir" valgrind -q --leak-check=full --show-leak-kinds=definite,indirect \
      --errors-for-leak-kinds=definite,indirect --error-exitcode=99
  else
    cat "$dir/log"
    fail
  fi
else
  for cc in gcc clang; do
    if ! command -v $cc > /dev/null 2>&1; then
      skip "$cc is not here"
      continue
    fi
    # c23 was called c2x, and c17 c18, before they were finished.
    known=""
    for std in $stds; do
      case $std in c17) names="c17 c18" ;; c23) names="c23 c2x" ;; *) names=$std ;; esac
      one=""
      for name in $names; do
        if accepts $cc -std="$name"; then one=$name; break; fi
      done
      if test -n "$one"; then known="$known $one"; else skip "$cc does not know $std"; fi
    done
    newest=${known##* }
    for std in $known; do
      if test "$std" = c99 || test "$std" = "$newest"; then
        check "$cc $std -O2" $cc -std="$std" -O2
      elif (for file in $core $tests; do echo "$file"; done | xargs -P "$jobs" -n 4 \
          $cc -std="$std" -fsyntax-only -Isrc -Itests/core $warnings -Werror $gsl_cflags) \
          > "$work/log" 2>&1; then
        echo "ok - compiles: $cc $std"
        pass
      else
        echo "not ok - compiles: $cc $std"
        sed 's/^/  /' "$work/log"
        fail
      fi
    done
    if accepts $cc -fsanitize=address,undefined; then
      check "$cc address,undefined" $cc -std=c99 -O1 -g -fno-omit-frame-pointer \
        -fsanitize=address,undefined -fno-sanitize-recover=all
    else
      skip "$cc has no sanitizers here"
    fi
  done
fi

echo "core: $passed passed, $failed failed, $skipped skipped"
test $failed = 0
