#!/bin/sh
# Ends what a check has left running: processes with a file of their number in STATE/pids, and the
# name of STATE in their environment, so that a number that was given again harms no other one.
#
#   tools/end-processes.sh STATE
for file in "$1"/pids/*; do
  pid=${file##*/}
  if cat "/proc/$pid/environ" 2> /dev/null | tr '\0' '\n' |
    grep -qxF "ROTDYN_KILL_STATE=$1"; then kill -9 "$pid" 2> /dev/null; fi
done
sleep 0.2
