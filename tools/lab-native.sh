#!/bin/sh
# Builds web/core, the core and web/tests/native.c as a program with GSL: what WebAssembly is
# compared with. CC, CFLAGS.
#
#   tools/lab-native.sh PROGRAM
. "${0%/*}/common.sh"

case $1 in /*) program=$1 ;; *) program=$(pwd)/$1 ;; esac
gsl_flags=$(pkg-config --cflags gsl 2> /dev/null)
gsl_libs=$(pkg-config --libs gsl 2> /dev/null || echo "-lgsl -lgslcblas -lm")
flags="-std=c99 -O2 -ffp-contract=off $CFLAGS $gsl_flags -Isrc/core -Iinst/include"
# shellcheck disable=SC2086
{ find src/core web/core -name '*.c' ! -name gsl_few.c; echo web/tests/native.c; } |
  xargs -P "$cores" -I{} sh -c 'file=$1 dir=$2; shift 2
  "$@" -c "$file" -o "$dir/$(echo "${file%.c}" | tr / -).o"' build {} "$work" ${CC:-cc} $flags &&
  ${CC:-cc} $CFLAGS "$work"/*.o $gsl_libs -o "$program" ||
  { echo "lab: the native program does not compile" >&2; exit 1; }
