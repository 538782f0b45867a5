#!/bin/sh
# Sourced by the scripts beside it: the top folder, a scratch folder, the environment.
# shellcheck shell=sh

cd "$(dirname "$0")/.." || exit 1
top=$(pwd)

work=$(mktemp -d "${TMPDIR:-/tmp}/rotdyn.XXXXXX") || exit 1
trap 'rm -rf "$work"' 0
trap 'exit 1' HUP INT TERM

cores=$(getconf _NPROCESSORS_ONLN 2> /dev/null || echo 1)

# make calls these scripts; a make that R starts must not inherit its flags.
unset MAKEFLAGS MFLAGS MAKELEVEL MAKEOVERRIDES

# Without a UTF-8 locale R escapes other characters than ASCII, and snapshots differ.
case ${LC_ALL:-${LC_CTYPE:-$LANG}} in
  *[Uu][Tt][Ff]8* | *[Uu][Tt][Ff]-8*) ;;
  *) LC_ALL=C.UTF-8; export LC_ALL ;;
esac

# Tests that read files of the repository find it by this name.
ROTDYN_ROOT=$top
export ROTDYN_ROOT

# Reference data beside the repository. Tests find it by this name, because R CMD check runs them in
# a folder of its own.
if test -z "$ROTDYN_SHARED" && test -d ../shared; then
  ROTDYN_SHARED=$(cd ../shared && pwd)
  export ROTDYN_SHARED
fi

# build_tarball FOLDER [--no-build-vignettes]: leaves its path in $tarball. Installing from the
# tarball keeps object files out of the working tree and tests what users install.
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
