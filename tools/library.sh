#!/bin/sh
# Builds the C core as a library: librotdyn.so.1 (.dylib), librotdyn.a, rotdyn.pc, rotdyn.h. Needs a
# C compiler and GSL, not R.
#
#   tools/library.sh [PREFIX]     installed under PREFIX; without one, under ./library
#
# CC, CFLAGS, GSL_CFLAGS, GSL_LIBS, INCLUDE_DIR, LIB_DIR count, as they do for configure.

prefix=${1:-$(cd "$(dirname "$0")/.." && pwd)/library}
case $prefix in /*) ;; *) prefix=$(pwd)/$prefix ;; esac
cd "$(dirname "$0")/.." || exit 1

work=$(mktemp -d "${TMPDIR:-/tmp}/rotdyn-library.XXXXXX") || exit 1
trap 'rm -rf "$work"' 0
trap 'exit 1' HUP INT TERM

fail() { echo "library: $*" >&2; exit 1; }

CC=${CC:-cc}
version=$(sed -n 's/^#define ROTDYN_VERSION *"\(.*\)"/\1/p' inst/include/rotdyn.h)
major=$(sed -n 's/^#define ROTDYN_API_MAJOR \([0-9]*\).*/\1/p' inst/include/rotdyn.h)

if gsl_libs=$(pkg-config --libs gsl 2> /dev/null); then gsl_cflags=$(pkg-config --cflags gsl)
elif gsl_libs=$(gsl-config --libs 2> /dev/null); then gsl_cflags=$(gsl-config --cflags)
else gsl_libs="-lgsl -lgslcblas -lm" gsl_cflags=""
fi
gsl_cflags="${GSL_CFLAGS:-${INCLUDE_DIR:+-I$INCLUDE_DIR} $gsl_cflags}"
gsl_libs="${GSL_LIBS:-${LIB_DIR:+-L$LIB_DIR} $gsl_libs}"

# accepts FLAG...: does the compiler make an object with it?
accepts() {
  echo 'int main(void) { return 0; }' > "$work/empty.c"
  $CC -Werror "$@" -c "$work/empty.c" -o "$work/empty.o" > /dev/null 2>&1
}

# Without contraction of a * b + c, as configure has it: the same bits as in R.
flags="-fPIC -DROTDYN_BUILD"
for flag in -std=c99 -ffp-contract=off -fvisibility=hidden; do
  ! accepts "$flag" || flags="$flags $flag"
done
flags="$flags ${CFLAGS:--O2}"

jobs=$(getconf _NPROCESSORS_ONLN 2> /dev/null || echo 1)
# shellcheck disable=SC2086
find src/core -name '*.c' | xargs -P "$jobs" -I{} sh -c 'file=$1 dir=$2; shift 2
  "$@" -Isrc/core -c "$file" -o "$dir/$(echo "${file%.c}" | tr / -).o"' \
  build {} "$work" $CC $flags $gsl_cflags || fail "the core does not compile"

# One object, in which all names but the interface's are local.
if ld -r -o "$work/rotdyn.o" "$work"/src-core-*.o 2> /dev/null &&
  { objcopy --localize-hidden "$work/rotdyn.o" 2> /dev/null || test "$(uname)" = Darwin; }; then
  members=$work/rotdyn.o
else
  members=$(echo "$work"/src-core-*.o)
  echo "library: no ld or objcopy: the static library shows the names of the core, too"
fi
rm -f "$work/empty.o"
# shellcheck disable=SC2086
ar rcs "$work/librotdyn.a" $members || fail "ar"

if test "$(uname)" = Darwin; then
  shared=librotdyn.$major.dylib link=librotdyn.dylib
  echo '_rotdyn_*' > "$work/names"
  only="-dynamiclib -install_name $prefix/lib/$shared -exported_symbols_list $work/names"
else
  shared=librotdyn.so.$major link=librotdyn.so
  echo '{ global: rotdyn_*; local: *; };' > "$work/names"
  only="-shared -Wl,-soname,$shared -Wl,--version-script,$work/names -Wl,--no-undefined"
fi
# shellcheck disable=SC2086
$CC $only $flags "$work"/src-core-*.o $gsl_libs -lm -o "$work/$shared" || fail "the link"

# What it shows: the functions of the table, and the table.
wanted=$({ sed -n 's/^ *X(.*, \([a-z_]*\), *(.*/\1/p; s/^ *X(.*, \([a-z_]*\), *\\$/\1/p' \
  inst/include/rotdyn.h; echo get_api; } | sed 's/^/rotdyn_/' | sort)
shown=$(nm -g "$work/$shared" 2> /dev/null | sed -n 's/.* T _\{0,1\}\(.*\)/\1/p' | sort)
if test -n "$shown" && test "$shown" != "$wanted"; then
  echo "$shown" > "$work/shown"
  echo "$wanted" | diff - "$work/shown" >&2
  fail "the shared library shows other names than those of rotdyn.h"
fi

mkdir -p "$prefix/lib/pkgconfig" "$prefix/include" || exit 1
cp "$work/librotdyn.a" "$work/$shared" "$prefix/lib/" && ln -sf "$shared" "$prefix/lib/$link" &&
  cp inst/include/rotdyn.h "$prefix/include/" || fail "nothing can be written to $prefix"
cat > "$prefix/lib/pkgconfig/rotdyn.pc" <<PC
prefix=$prefix
libdir=\${prefix}/lib
includedir=\${prefix}/include

Name: rotdyn
Description: Rotational dynamics: models, their choice, and errors with a bound
Version: $version
Libs: -L\${libdir} -lrotdyn
Libs.private: $gsl_libs -lm
Cflags: -I\${includedir}
PC
echo "library: rotdyn $version, $(echo "$wanted" | wc -l | tr -d ' ') functions, in $prefix"
