#!/bin/sh
# Do the error bars of estimates and fits from records hold the truth? Each script of
# bench/measurement/ simulates records whose motion is known, prints a line for each class and ends
# with the number that passed; records.R is what they share. Without SEED another one is drawn each
# time.
#   check-measurement.sh [RECORDS of each class [SEED]]
set -eu
cd "$(dirname "$0")/.."
seed=${2:-$(date +%s)}
echo "seed $seed"
bad=0
for script in bench/measurement/*.R; do
  case $script in */records.R) continue ;; esac
  echo "$script"
  Rscript "$script" "${1:-500}" "$seed" || bad=1
done
exit $bad
