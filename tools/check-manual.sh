#!/bin/sh
# Builds the PDF manual from man/ and throws it away: it must build without an error.
. "${0%/*}/common.sh"

sh tools/setup.sh manual || exit 1
if R CMD Rd2pdf --batch --no-preview --output="$work/rotdyn.pdf" "$top" > "$work/log" 2>&1 \
  < /dev/null && test -s "$work/rotdyn.pdf"; then
  echo "manual: 1 passed, 0 failed"
else
  tail -n 40 "$work/log"
  echo "manual: 0 passed, 1 failed"
  exit 1
fi
