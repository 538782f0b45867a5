#!/bin/sh
# Prints src/Makevars.objects, which both Makevars read: `make objects` writes it.
# make has no portable way to find files in folders.
cd "$(dirname "$0")/../src" || exit 1
echo "# Made by make objects."
for part in core glue; do
  find $part -name '*.c' | LC_ALL=C sort |
    awk -v name="$(echo $part | tr a-z A-Z)" '
      NR == 1 { printf "%s =", name }
      { sub(/[.]c$/, ".o"); printf " \\\n  %s", $0 }
      END { print "" }'
done
