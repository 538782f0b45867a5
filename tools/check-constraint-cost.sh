#!/bin/sh
# What a constraint costs: the lines of code that a bead on a turning hoop takes, without comments,
# help and empty lines, and the other files of the package that name it. Its drawing, its lesson and
# tests, and what commands make (NAMESPACE, man/, src/Makevars.objects) do not count.
#
#   tools/check-constraint-cost.sh [LINES [FILES]]
cd "$(dirname "$0")/.." || exit 1
most=${1:-160} files=${2:-2}

own="R/scene-hoop.R R/constraint-hoop.R src/core/scene/hoop/hoop.c src/core/scene/hoop/hoop.h"
# shellcheck disable=SC2086
lines=$(awk '
  FNR == 1 { open = 0; c = FILENAME ~ /[.][ch]$/ }
  !c && /^[ \t]*#/ { next }
  c && open { if (/\*\//) open = 0; next }
  c && /^[ \t]*\/\*/ { if (!/\*\//) open = 1; next }
  /[^ \t]/ { n++ }
  END { print n }' $own)
names='(scene|rot|draw)_hoop|hoop_(constraint|frames)|scene/hoop'
others=$(find R src -name '*.[Rch]' ! -name '*hoop*' -exec \
  grep -HE "^[^#]*($names)|#include .scene/hoop" {} + |
  cut -d: -f1 | sort -u)
n=$(echo "$others" | wc -l)
echo "constraint cost: $lines lines of code, named in $n other files:" $others
test "$lines" -le "$most" && test "$n" -le "$files"
