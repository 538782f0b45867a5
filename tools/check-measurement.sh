#!/bin/sh
# Do the error bars of estimates and fits from records hold the truth? Each script of
# bench/measurement/ simulates records whose motion is known, prints a line for each class and ends
# with the number that passed; records.R and peers.R are what they share. First the smoother against
# quadruple precision, and random records without a negative variance. Without SEED another one is
# drawn each time.
#   check-measurement.sh [RECORDS of each class [SEED]]
set -eu
cd "$(dirname "$0")/.."
seed=${2:-$(date +%s)}
echo "seed $seed"
bad=0
build=$(mktemp -d)
trap 'rm -rf "$build"' EXIT
${CC:-gcc} -std=c99 -O2 -ffp-contract=off -Isrc/core -Itests/core $(gsl-config --cflags) \
  tests/core/measure/test_smooth.c src/core/measure/smooth*.c src/core/ground/status.c \
  $(gsl-config --libs) -lm -o "$build/smooth"
echo "tests/core/measure/test_smooth.c, $((${1:-500} * 200)) random records"
ROT_SMOOTH_RECORDS=$((${1:-500} * 200)) ROT_SMOOTH_SEED=$seed "$build/smooth" || bad=1
for script in bench/measurement/*.R; do
  case $script in */records.R | */peers.R) continue ;; esac
  echo "$script"
  Rscript "$script" "${1:-500}" "$seed" || bad=1
done
exit $bad
