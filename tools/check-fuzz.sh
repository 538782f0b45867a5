#!/bin/sh
# Random calls of every exported function, some with evil arguments, and of the verbs on what comes
# back; damaged mesh and link files (tools/fuzz.R). A crash, a call that does not stop, an error or
# a warning that is not the package's own, or growing files or memory is a failure.
#   check-fuzz.sh [MINUTES [SEED]]     30 minutes of processes with new seeds, which are printed
# SANITIZED=yes builds the package with gcc's address and undefined behaviour sanitizers first; a
# finding of theirs ends the process, which is a failure.
. "${0%/*}/common.sh"

sh tools/setup.sh test || exit 1
mkdir "$work/library"
preload=
if test "${SANITIZED:-no}" = yes; then
  preload=$(gcc -print-file-name=libasan.so)
  if ! test -f "$preload"; then
    echo "check-fuzz: gcc has no libasan"
    exit 1
  fi
  checks="-fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all"
  cat > "$work/Makevars" << MAKEVARS
CC = gcc
CFLAGS = -g -O1 -fno-omit-frame-pointer $checks
LDFLAGS += $checks
MAKEVARS
  R_MAKEVARS_USER=$work/Makevars
  # R keeps its memory when it ends. Allocations beyond the memory are errors of R's, not ends of
  # the process; freed blocks that are kept to find later reads must not look like a leak.
  ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1:quarantine_size_mb=8:abort_on_error=1
  ASAN_OPTIONS=$ASAN_OPTIONS:handle_segv=0:allow_user_segv_handler=1
  UBSAN_OPTIONS=print_stacktrace=1
  export R_MAKEVARS_USER ASAN_OPTIONS UBSAN_OPTIONS
fi
{
  build_tarball "$work" --no-build-vignettes &&
    (LD_PRELOAD=$preload; export LD_PRELOAD; install_into "$work/library")
} > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
LD_PRELOAD=$preload R_LIBS="$work/library:$R_LIBS" Rscript tools/fuzz.R "$@"
