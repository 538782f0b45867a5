#!/bin/sh
# Do the reported errors cover the true ones? Random scenes for each model of the axle, judged in
# quadruple precision (bench/coverage/). Needs gcc and libquadmath.
#   check-coverage.sh [SCENES]
set -eu
cd "$(dirname "$0")/.."
build=$(mktemp -d)
trap 'rm -rf "$build"' EXIT
${CC:-gcc} -std=gnu11 -O2 -ffp-contract=off -Ibench/coverage -Isrc $(gsl-config --cflags) \
  bench/coverage/coverage.c bench/coverage/truth.c src/rot_*.c \
  $(gsl-config --libs) -lquadmath -lm -o "$build/coverage"
"$build/coverage" "${1:-1000}"
