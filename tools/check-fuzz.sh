#!/bin/sh
# Random calls of every exported function, some with evil arguments, and of the verbs on what comes
# back; damaged mesh and link files (tools/fuzz.R). A crash, a call that does not stop, an error or
# a warning that is not the package's own, or growing files or memory is a failure.
#   check-fuzz.sh [MINUTES [SEED]]     30 minutes of processes with new seeds, which are printed
. "${0%/*}/common.sh"

sh tools/setup.sh test || exit 1
mkdir "$work/library"
{ build_tarball "$work" --no-build-vignettes && install_into "$work/library"; } \
  > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
R_LIBS="$work/library:$R_LIBS" Rscript tools/fuzz.R "$@"
