#!/bin/sh
# Do the tests notice small wrong changes of the sources? tools/mutants.R says how.
#
#   tools/check-mutants.sh [NUMBER [SEED]]
. "${0%/*}/common.sh"

number=${1:-200} seed=${2:-$(date +%Y%m%d)}

sh tools/setup.sh test || exit 1
build_tarball "$work" --no-build-vignettes > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
# Copies as of now: a run takes long, and files may change meanwhile.
mkdir "$work/sources" "$work/library"
cp -R tests "$work/tests"
cp tools/mutants.R "$work/mutants.R"
tar xzf "$tarball" -C "$work/sources" || exit 1

# Without debugging information, objects of the same code are the same bytes. The objects stay.
echo "CFLAGS = -O2" > "$work/Makevars"
R_MAKEVARS_USER=${MUTANTS_MAKEVARS:-$work/Makevars}
export R_MAKEVARS_USER
MAKEFLAGS=-j$cores R CMD INSTALL --no-test-load --library="$work/library" "$work/sources/rotdyn" \
  < /dev/null > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }

echo "mutants: $number, seed $seed"
NOT_CRAN=true R_LIBS="$work/library${R_LIBS:+:$R_LIBS}" \
  Rscript "$work/mutants.R" "$work/sources/rotdyn" "$work/tests" "$work/library" "$number" "$seed" \
  2> "$work/log"
status=$?
# Changed code that crashes prints a traceback; it is of interest where the script itself failed.
grep -q '^Execution halted' "$work/log" && status=2
test $status -lt 2 || tail -n 40 "$work/log"
exit $status
