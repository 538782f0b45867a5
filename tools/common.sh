#!/bin/sh
# Sourced by the scripts beside it: the top folder, a scratch folder, the environment.
# shellcheck shell=sh

cd "$(dirname "$0")/.." || exit 1
top=$(pwd)

work=$(mktemp -d "${TMPDIR:-/tmp}/rotdyn.XXXXXX") || exit 1
trap 'rm -rf "$work"' 0
trap 'exit 1' HUP INT TERM

cores=$(getconf _NPROCESSORS_ONLN 2> /dev/null || echo 1)

# We are called by make, and R calls make again: that one is no part of ours.
unset MAKEFLAGS MFLAGS MAKELEVEL MAKEOVERRIDES

# Without a UTF-8 locale R escapes what is not ASCII, and the text tests see other text.
case ${LC_ALL:-${LC_CTYPE:-$LANG}} in
  *[Uu][Tt][Ff]8* | *[Uu][Tt][Ff]-8*) ;;
  *) LC_ALL=C.UTF-8; export LC_ALL ;;
esac

# The tests that look at the repository itself find it by this name.
ROTDYN_ROOT=$top
export ROTDYN_ROOT

# Reference data that may lie beside the repository. Tests that want it ask for this name, since
# they also run far from here, in R CMD check's own folder.
if test -z "$ROTDYN_SHARED" && test -d ../shared; then
  ROTDYN_SHARED=$(cd ../shared && pwd)
  export ROTDYN_SHARED
fi

# build_tarball FOLDER [--no-build-vignettes]: leaves its path in $tarball. Building from the
# tarball keeps object files out of the working tree and tests what a user would get.
build_tarball() {
  folder=$1
  shift
  rm -f "$folder"/rotdyn_*.tar.gz
  (cd "$folder" && MAKEFLAGS=-j$cores R CMD build "$@" "$top" < /dev/null) &&
    tarball=$(ls "$folder"/rotdyn_*.tar.gz)
}

install_into() {
  MAKEFLAGS=-j$cores R CMD INSTALL --no-test-load --library="$1" "$tarball" < /dev/null
}
