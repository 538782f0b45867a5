#!/bin/sh
# Do the reported errors cover the true ones? Random scenes for each model of the axle, of the
# incline, of beads on hoops, of chains of pendulums, of the heavy top (to 1e9 rad and more) and of
# free bodies with rotors or without, and for the installed package random R functions as torque
# laws, narrow changes of such laws, random curves, audits of random motions, bodies at rest on
# redundant supports, and random gears, drives, rotors, inclines, dry friction, long spans and short
# pulses, judged in quadruple precision, orbits by Kepler's equation and loosely solved pendulums by
# Taylor series, bodies at rest by linear programs of lpSolve (bench/coverage/). What is estimated
# from measured records, with correlated noise, counters and quadratic damping among them, is judged
# by check-measurement.sh. Needs gcc, libquadmath and the R package lpSolve. Without SEED another
# one is drawn each time. 1000 scenes of each class are 41,000 in all: each part ends with the
# number of its own.
#   check-coverage.sh [SCENES of each class [SEED]]
set -eu
cd "$(dirname "$0")/.."
core=$(find src/core -name "*.c")
build=$(mktemp -d)
trap 'rm -rf "$build"' EXIT
${CC:-gcc} -std=gnu11 -O2 -ffp-contract=off -Ibench/coverage -Isrc/core $(gsl-config --cflags) \
  bench/coverage/coverage.c bench/coverage/truth.c $core \
  $(gsl-config --libs) -lquadmath -lm -o "$build/coverage"
for program in laws chains curves; do
  ${CC:-gcc} -std=gnu11 -O2 bench/coverage/$program.c -lquadmath -lm -o "$build/$program"
done
for program in top free forced gyrostat incline hoop pendulums; do
  ${CC:-gcc} -std=gnu11 -O2 -ffp-contract=off -Isrc/core $(gsl-config --cflags) \
    bench/coverage/$program.c $core $(gsl-config --libs) -lquadmath -lm -o "$build/$program"
done
seed=${2:-$(date +%s)}
echo "seed $seed"
bad=0
"$build/coverage" "${1:-1000}" "$seed" || bad=1
"$build/incline" "${1:-1000}" "$seed" || bad=1
"$build/hoop" "${1:-1000}" "$seed" || bad=1
"$build/pendulums" "$((${1:-1000} / 3))" "$seed" || bad=1
"$build/top" "${1:-1000}" "$seed" || bad=1
"$build/free" "${1:-1000}" "$seed" || bad=1
"$build/forced" "$((${1:-1000} / 2))" "$seed" || bad=1
"$build/gyrostat" "${1:-1000}" "$seed" || bad=1
Rscript bench/coverage/laws.R "$build/laws" "$((${1:-1000} / 4))" "$seed" || bad=1
Rscript bench/coverage/curves.R "$build/curves" "${1:-1000}" "$seed" || bad=1
Rscript bench/coverage/narrow.R "$((${1:-1000} / 3))" "$seed" || bad=1
Rscript bench/coverage/audits.R "$((${1:-1000} / 4))" "$seed" || bad=1
Rscript bench/coverage/equations.R "${1:-1000}" "$seed" || bad=1
Rscript bench/coverage/statics.R "$((${1:-1000} / 2))" "$seed" || bad=1
Rscript bench/coverage/scenes.R "$build/chains" "${1:-1000}" "$seed" || bad=1
exit $bad
