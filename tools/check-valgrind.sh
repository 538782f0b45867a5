#!/bin/sh
# The C core's tests and tests/valgrind/boundary.R under valgrind: nothing of ours may be lost,
# no memory may be read or written out of place.
. "${0%/*}/common.sh"

sh tools/setup.sh valgrind || exit 1
passed=0 failed=0
tally() {
  if test "$1" = 0; then passed=$((passed + 1)); echo "ok - $2"
  else failed=$((failed + 1)); echo "not ok - $2"; fi
}

echo "==== C core"
sh tests/core/run.sh --valgrind
tally $? "the core's tests under valgrind"

echo "==== C boundary, in R"
mkdir "$work/library"
{ build_tarball "$work" --no-build-vignettes && install_into "$work/library"; } \
  > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
R_LIBS="$work/library:$R_LIBS" R -d "valgrind --leak-check=full --show-leak-kinds=definite \
  --num-callers=30 --log-file=$work/valgrind.log" --vanilla --no-echo \
  -f tests/valgrind/boundary.R < /dev/null
tally $? "tests/valgrind/boundary.R ends well"

# valgrind writes a block a finding, blocks parted by empty lines. R itself loses some memory when
# it ends, so a loss counts only where the stack passes through the package or through GSL; a bad
# read, write or free counts wherever it is.
awk '
  function judge() {
    ours = block ~ /\((rot|ffi)[a-z0-9_]*\.[ch]:[0-9]+\)|\(init\.c:[0-9]+\)|rotdyn\.so|libgsl/
    if (block ~ /Invalid (read|write|free)|Mismatched free|Process terminating/) bad = 1
    else if (block ~ /definitely lost in loss record|uninitialised/ && ours) bad = 1
    else bad = 0
    if (bad) { printf "%s\n", block; found++ }
    block = ""
  }
  { sub(/^==[0-9]+== ?/, "") }
  $0 == "" { judge(); next }
  { block = block "  " $0 "\n" }
  END { judge(); exit found > 0 }' "$work/valgrind.log"
tally $? "valgrind's log blames nothing on the package"
grep -E "definitely lost:|ERROR SUMMARY" "$work/valgrind.log"

echo "valgrind: $passed passed, $failed failed"
test $failed = 0
