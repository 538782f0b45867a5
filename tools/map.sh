#!/bin/sh
# What each file of R/ and src/ is for: the first sentence of its first comment; of x.c with x.h
# that of the header.
#
#   tools/map.sh [PATTERN]
cd "$(dirname "$0")/.." || exit 1

find R src -name '*.[Rch]' | LC_ALL=C sort | grep -e "${1:-.}" | while read -r file; do
  case $file in *.c) test ! -f "${file%.c}.h" || continue ;; esac
  awk -v file="$file" '
    /^#\x27? |^\/\*|^ \*/ {
      line = $0
      gsub(/^(#\x27?|\/\*| \*) *| *\*\/$/, "", line)
      text = text (text == "" ? "" : " ") line
      if (text ~ /[.:;]( |$)/ || $0 ~ /\*\/$/ || NR > 4) exit
      next
    }
    { exit }
    END {
      if (match(text, /[.:;]( |$)/)) text = substr(text, 1, RSTART - 1)
      print file ": " text
    }' "$file"
done
