#!/bin/sh
# Random and damaged calls of the C interface, by two threads (tests/core/api/test_damage.c), under
# the sanitizers of gcc or clang: of addresses and undefined behaviour, then of threads.
#
#   CALLS=1000000 SEED=1 tools/check-damage.sh
#
# OpenMP is left out: the sanitizer of threads does not know it.
. "${0%/*}/common.sh"

calls=${CALLS:-1000000} seed=${SEED:-1} passed=0 failed=0
if pkg-config --exists gsl 2> /dev/null; then
  flags=$(pkg-config --cflags gsl) libs=$(pkg-config --libs gsl)
else
  flags=$(gsl-config --cflags) libs=$(gsl-config --libs)
fi

# with SANITIZERS: builds the core and the test, runs it.
with() {
  for cc in clang gcc; do
    echo 'int main(void) { return 0; }' > "$work/empty.c"
    if $cc "-fsanitize=$1" "$work/empty.c" -o "$work/empty" > "$work/log" 2>&1; then break; fi
    cc=
  done
  if test -z "$cc"; then
    echo "skip - no compiler has -fsanitize=$1"
    return
  fi
  # shellcheck disable=SC2046,SC2086
  if $cc -std=c99 -g -O1 -ffp-contract=off -fno-omit-frame-pointer "-fsanitize=$1" \
    -fno-sanitize-recover=all -Isrc/core -Itests/core -Iinst/include $flags \
    tests/core/api/test_damage.c $(find src/core -name '*.c') -o "$work/damage" $libs -lm \
    -lpthread > "$work/log" 2>&1 &&
    ROTDYN_CALLS=$calls ROTDYN_SEED=$seed setarch -R "$work/damage" >> "$work/log" 2>&1; then
    passed=$((passed + 1)) verdict=ok
  else
    failed=$((failed + 1)) verdict="not ok"
  fi
  echo "$verdict - $calls calls with -fsanitize=$1, $cc, seed $seed"
  tail -n 60 "$work/log"
}

with address,undefined
with thread
echo "damage: $passed passed, $failed failed"
test $failed = 0
