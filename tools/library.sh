#!/bin/sh
# Builds the C core as a library: librotdyn.so.1 (.dylib), librotdyn.a, rotdyn.pc, rotdyn.h. Needs a
# C compiler and GSL, not R.
#
#   tools/library.sh [PREFIX]     installed under PREFIX; without one, under ./library
#
# CC, CFLAGS, CPPFLAGS, LDFLAGS count, and GSL_CFLAGS, GSL_LIBS, INCLUDE_DIR, LIB_DIR as they do for
# configure. With DESTDIR files are written below that folder, for a package that is installed under
# PREFIX. LIBDIR: the folder of libraries, in place of PREFIX/lib. The shared library is
# librotdyn.so.MAJOR.MINOR with the soname librotdyn.so.MAJOR; its symbols have the version
# ROTDYN_MAJOR.

prefix=${1:-$(cd "$(dirname "$0")/.." && pwd)/library}
case $prefix in /*) ;; *) prefix=$(pwd)/$prefix ;; esac
cd "$(dirname "$0")/.." || exit 1

work=$(mktemp -d "${TMPDIR:-/tmp}/rotdyn-library.XXXXXX") || exit 1
trap 'rm -rf "$work"' 0
trap 'exit 1' HUP INT TERM

fail() { echo "library: $*" >&2; exit 1; }

CC=${CC:-cc}
version=$(sed -n 's/^#define ROTDYN_VERSION *"\(.*\)"/\1/p' inst/include/rotdyn.h)
minor=$(sed -n 's/^#define ROTDYN_API_MINOR \([0-9]*\).*/\1/p' inst/include/rotdyn.h)
libdir=${LIBDIR:-$prefix/lib}
case $libdir in /*) ;; *) libdir=$prefix/$libdir ;; esac
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
# x87 registers have extended precision, which ground/ieee.h refuses.
extended="-msse2 -mfpmath=sse"
if ! echo '#include "ground/ieee.h"' | $CC $CFLAGS -Isrc/core -E - > /dev/null 2>&1 &&
  echo '#include "ground/ieee.h"' | $CC $CFLAGS $extended -Isrc/core -E - > /dev/null 2>&1; then
  flags="$flags $extended"
fi
flags="$flags ${CFLAGS:--O2}"

jobs=$(getconf _NPROCESSORS_ONLN 2> /dev/null || echo 1)
# shellcheck disable=SC2086
find src/core -name '*.c' | xargs -P "$jobs" -I{} sh -c 'file=$1 dir=$2; shift 2
  "$@" -Isrc/core -c "$file" -o "$dir/$(echo "${file%.c}" | tr / -).o"' \
  build {} "$work" $CC $CPPFLAGS $flags $gsl_cflags || fail "the core does not compile"

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
  shared=librotdyn.$major.dylib file=librotdyn.$major.$minor.dylib link=librotdyn.dylib
  echo '_rotdyn_*' > "$work/names"
  only="-dynamiclib -install_name $libdir/$shared -compatibility_version $major \
-current_version $major.$minor -exported_symbols_list $work/names"
else
  shared=librotdyn.so.$major file=librotdyn.so.$major.$minor link=librotdyn.so
  echo "ROTDYN_$major { global: rotdyn_*; local: *; };" > "$work/names"
  only="-shared -Wl,-soname,$shared -Wl,--version-script,$work/names -Wl,--no-undefined"
fi
# shellcheck disable=SC2086
$CC $only $flags $LDFLAGS "$work"/src-core-*.o $gsl_libs -lm -o "$work/$file" || fail "the link"

# What it shows: the functions of the table, and the table.
wanted=$({ sed -n 's/^ *X(.*, \([a-z_]*\), *(.*/\1/p; s/^ *X(.*, \([a-z_]*\), *\\$/\1/p' \
  inst/include/rotdyn.h; echo get_api; } | sed 's/^/rotdyn_/' | sort)
shown=$(nm -g "$work/$file" 2> /dev/null |
  sed -n 's/@.*//; s/.* T _\{0,1\}\(.*\)/\1/p' | sort)
if test -n "$shown" && test "$shown" != "$wanted"; then
  echo "$shown" > "$work/shown"
  echo "$wanted" | diff - "$work/shown" >&2
  fail "the shared library shows other names than those of rotdyn.h"
fi

to=$DESTDIR$libdir include=$DESTDIR$prefix/include
mkdir -p "$to/pkgconfig" "$include" || exit 1
cp "$work/librotdyn.a" "$work/$file" "$to/" && ln -sf "$file" "$to/$shared" &&
  ln -sf "$shared" "$to/$link" && cp inst/include/rotdyn.h "$include/" ||
  fail "nothing can be written to $to"
cat > "$to/pkgconfig/rotdyn.pc" <<PC
prefix=$prefix
libdir=$libdir
includedir=\${prefix}/include

Name: rotdyn
Description: Rotational dynamics: models, their choice, and errors with a bound
Version: $version
Libs: -L\${libdir} -lrotdyn
Libs.private: $gsl_libs -lm
Cflags: -I\${includedir}
PC
echo "library: rotdyn $version, $(echo "$wanted" | wc -l | tr -d ' ') functions, in $DESTDIR$prefix"
