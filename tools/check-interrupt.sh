#!/bin/sh
# Does an interrupt stop every long call within a second? Each call of tools/interrupt.R runs in a
# process of its own, gets SIGINT after a second, and says how long it took to stop.
. "${0%/*}/common.sh"

sh tools/setup.sh test || exit 1
mkdir "$work/library"
{ build_tarball "$work" --no-build-vignettes && install_into "$work/library"; } \
  > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
R_LIBS="$work/library:$R_LIBS" Rscript tools/interrupt.R
