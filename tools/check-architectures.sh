#!/bin/sh
# `make check-architectures`: the C core on other processors, by Debian's cross compilers and qemu's
# user mode. For each of ARCHITECTURES (default: all five):
#
#   digests of SCENES (1000) random scenes of tools/architectures.c beside those of this machine:
#     - with the libraries of the architecture: texts, models and events are the same, numbers are
#       within the error figures of both;
#     - with one library of functions for all (musl's sources, and GSL's step of rk8pd, compiled
#       here without contraction): the same bits;
#   tests/core with the libraries of the architecture (TESTS=no leaves them out: under an emulator
#     they take some ten minutes of processor time each).
#
# On this machine, too: AVX2 against plain instructions, clang against gcc, and musl's C library.
# Nothing of the system is changed but for the packages that tools/setup.sh names: lists and
# libraries of the other architectures are kept in a folder of their own. What cannot be had is
# skipped with a word. The last line is `architectures: N passed, N failed, N skipped`.
. "${0%/*}/common.sh"

scenes=${SCENES:-1000}
sh tools/setup.sh architectures

passed=0 failed=0 skipped=0
pass() { passed=$((passed + 1)); echo "ok - $1"; }
miss() { failed=$((failed + 1)); echo "not ok - $1"; }
skip() { skipped=$((skipped + 1)); echo "skip - $1"; }

summary() {
  echo "architectures: $passed passed, $failed failed, $skipped skipped"
  test $failed = 0
  exit
}

# ---- GSL and sources of functions ---------------------------------------------------------------

# apt's lists in a folder of their own, so that the system need not know the architectures.
prepare_apt() {
  command -v apt-get > /dev/null 2>&1 && command -v dpkg-deb > /dev/null 2>&1 || return 1
  host=$(dpkg --print-architecture)
  . /etc/os-release
  mirror=$(cat /etc/apt/sources.list /etc/apt/sources.list.d/*.sources \
    /etc/apt/sources.list.d/*.list 2> /dev/null |
    sed -n 's/^URIs: *\([^ ]*debian\)\/*$/\1/p; s/^deb .*\(http[^ ]*debian\)\/* .*/\1/p' |
    head -n 1)
  test "$ID" = debian && test -n "$mirror" || return 1
  mkdir -p "$work/apt/lists/partial" "$work/apt/cache/archives/partial"
  : > "$work/apt/status"
  for kind in deb deb-src; do
    echo "$kind [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror" \
      "$VERSION_CODENAME main"
  done > "$work/apt/sources.list"
  cat > "$work/apt/conf" << CONF
Dir::State "$work/apt";
Dir::State::status "$work/apt/status";
Dir::Cache "$work/apt/cache";
Dir::Etc::sourcelist "$work/apt/sources.list";
Dir::Etc::sourceparts "/dev/null";
APT::Sandbox::User "root";
APT::Architectures { "$host"; "arm64"; "i386"; "armhf"; "ppc64el"; "s390x"; };
CONF
  echo "apt: lists of the other architectures"
  APT_CONFIG=$work/apt/conf apt-get update -qq > "$work/apt.log" 2>&1
  mkdir -p "$work/sources"
  (cd "$work/sources" && APT_CONFIG=$work/apt/conf apt-get source --download-only -qq gsl musl \
    >> "$work/apt.log" 2>&1 && for file in *.orig.tar.*z; do tar xf "$file" || exit 1; done) ||
    { tail -n 5 "$work/apt.log"; return 1; }
  gsl_source=$(dirname "$(find "$work/sources" -path '*/ode-initval2/rk8pd.c' | head -n 1)")
  musl=$(dirname "$(find "$work/sources" -name mkalltypes.sed | head -n 1)")/..
  test -f "$gsl_source/rk8pd.c" && test -f "$musl/include/alltypes.h.in"
}

# gsl_of DEBIAN: GSL's library and headers in $work/root-DEBIAN.
gsl_of() {
  root=$work/root-$1
  mkdir -p "$root/debs"
  (cd "$root/debs" && APT_CONFIG=$work/apt/conf apt-get download -qq "libgsl-dev:$1" \
    >> "$work/apt.log" 2>&1 && for deb in *.deb; do dpkg-deb -x "$deb" "$root"; done)
  libgsl=$(find "$root" -name libgsl.a | head -n 1)
  test -n "$libgsl" || return 1
  GSL_CFLAGS="-isystem $root/usr/include" GSL_LIBS="$libgsl ${libgsl%/*}/libgslcblas.a"
  export GSL_CFLAGS GSL_LIBS
}

functions="acos acosh asin asinh atan atan2 atanh cbrt cos cosh exp exp2 exp_data expm1 __expo2
  hypot log log10 log1p log2 log2_data log_data pow pow_data sin sincos sinh tan tanh __sin __cos
  __tan __rem_pio2 __rem_pio2_large __math_divzero __math_invalid __math_oflow __math_uflow
  __math_xflow"

# one_library NAME MUSL CC FLAGS...: objects of the functions that all processors compute alike.
one_library() {
  dir=$work/$1/one types=$2
  shift 2
  mkdir -p "$dir/include/bits" "$dir/empty"
  : > "$dir/empty/config.h"
  sed -f "$musl/tools/mkalltypes.sed" "$musl/arch/$types/bits/alltypes.h.in" \
    "$musl/include/alltypes.h.in" > "$dir/include/bits/alltypes.h"
  # shellcheck disable=SC2086
  for name in $functions; do
    "$@" -std=c99 -O2 -ffp-contract=off -ffreestanding -nostdinc -w -U__FP_FAST_FMA \
      -D_XOPEN_SOURCE=700 -I"$musl/arch/$types" -I"$musl/arch/generic" -I"$musl/src/include" \
      -I"$musl/src/internal" -I"$dir/include" -I"$musl/include" \
      -c "$musl/src/math/$name.c" -o "$dir/$name.o" || return 1
  done
  # shellcheck disable=SC2086
  "$@" -O2 -ffp-contract=off -w -I"$dir/empty" -I"$gsl_source" $GSL_CFLAGS \
    -c "$gsl_source/rk8pd.c" -o "$dir/rk8pd.o"
}

# ---- builds --------------------------------------------------------------------------------------

# core_of NAME CC FLAGS...: the core's archive, and the program with the system's functions and, if
# there are objects for it, with those of one_library().
core_of() {
  dir=$work/$1
  shift
  mkdir -p "$dir/core"
  # shellcheck disable=SC2086
  find src/core -name '*.c' | xargs -P "$cores" -I{} sh -c 'file=$1 dir=$2; shift 2
    "$@" -c "$file" -o "$dir/$(echo "${file%.c}" | tr / -).o"' \
    build {} "$dir/core" "$@" -std=c99 -O2 -ffp-contract=off -Isrc/core $GSL_CFLAGS || return 1
  ${AR:-ar} cr "$dir/librot.a" "$dir"/core/*.o || return 1
  # shellcheck disable=SC2086
  for kind in own one; do
    objects=""
    if test $kind = one; then
      test -f "$dir/one/rk8pd.o" || continue
      objects=$(echo "$dir"/one/*.o)
    fi
    "$@" -std=c99 -O2 -ffp-contract=off -Isrc/core -Itests/core tools/architectures.c \
      "$dir/librot.a" $objects -static $GSL_LIBS -lm -lpthread -o "$dir/$kind-program" || return 1
  done
}

# digest NAME own|one [EMULATOR]: the lines of the scenes and their hash.
digest() {
  program=$work/$1/$2-program lines=$work/$1/$2.txt
  test -x "$program" || return 1
  ${3:+"$3"} "$program" run "$scenes" > "$lines" || return 1
  echo "  $1, $2: $(wc -l < "$lines" | tr -d ' ') scenes, digest $(cksum < "$lines" | tr ' ' -)"
}

# beside NAME own|one: compared with this machine's. `one` must have the same bits.
beside() {
  test -f "$work/$1/$2.txt" || return 1
  "$work/here/own-program" compare "$work/here/$2.txt" "$work/$1/$2.txt" > "$work/compare.out"
  status=$?
  sed 's/^/  /' "$work/compare.out"
  if test "$2" = one; then cmp -s "$work/here/one.txt" "$work/$1/one.txt"; else test $status = 0; fi
}

# judged NAME LABEL: both digests of a build.
judged() {
  if beside "$1" own; then pass "$2: texts equal, numbers within the error figures"
  else miss "$2: texts equal, numbers within the error figures"; fi
  test -f "$work/$1/one.txt" || return 0
  if beside "$1" one; then pass "$2, one library of functions: the same bits"
  else miss "$2, one library of functions: the same bits"; fi
}

# ---- this machine --------------------------------------------------------------------------------

if ! prepare_apt; then
  skip "apt-get of Debian is not here, or knows no sources: no other architecture"
  summary
fi

echo "==== this machine, $host"
here=$(case $host in amd64) echo x86_64 ;; arm64) echo aarch64 ;; *) echo "" ;; esac)
if test -z "$here" || ! gsl_of "$host"; then
  skip "GSL's static library is not to be had for $host"
  summary
fi
# shellcheck disable=SC2086
if one_library here $here cc > "$work/log" 2>&1 && core_of here cc > "$work/log" 2>&1 &&
  digest here own && digest here one; then
  pass "builds: $host"
else
  cat "$work/log"
  miss "builds: $host"
  summary
fi

also() {
  name=$1 label=$2
  shift 2
  mkdir -p "$work/$name"
  cp -R "$work/here/one" "$work/$name/one"
  if core_of "$name" "$@" > "$work/log" 2>&1; then
    digest "$name" own && digest "$name" one && judged "$name" "$label"
  else
    cat "$work/log"
    miss "builds: $label"
  fi
}

# gcc's vectorizer makes fused operations in spite of -ffp-contract=off: configure forbids it, too.
if test "$host" = amd64; then
  case $(cat /proc/cpuinfo) in
    *avx2*) also avx2 "AVX2 and FMA" cc -mavx2 -mfma -fno-tree-slp-vectorize ;;
    *) skip "this processor has no AVX2" ;;
  esac
fi
if command -v clang > /dev/null 2>&1; then also clang "clang" clang
else skip "clang is not installed"; fi

# ---- the others ----------------------------------------------------------------------------------

# DEBIAN TRIPLET QEMU MUSL FLAGS...
of() {
  label=$1 triplet=$2 emulator=qemu-$3-static types=$4
  shift 4
  case " ${ARCHITECTURES:-arm64 i386 armhf ppc64el s390x} " in *" $label "*) ;; *) return ;; esac
  echo "==== $label"
  for program in "$triplet-gcc" "$emulator"; do
    command -v "$program" > /dev/null 2>&1 || { skip "$label: $program is not here"; return; }
  done
  gsl_of "$label" || { skip "$label: no GSL to be had"; return; }
  AR=$triplet-ar
  export AR
  # i386 runs here where the kernel has it.
  echo 'int main(void) { return 0; }' > "$work/empty.c"
  "$triplet-gcc" "$@" -static "$work/empty.c" -o "$work/empty" > "$work/log" 2>&1 ||
    { skip "$label: no static C library"; return; }
  if test "$label" = i386 && "$work/empty" 2> /dev/null; then emulator=""; fi
  if one_library "$label" "$types" "$triplet-gcc" "$@" > "$work/log" 2>&1 &&
    core_of "$label" "$triplet-gcc" "$@" > "$work/log" 2>&1 &&
    digest "$label" own $emulator && digest "$label" one $emulator; then
    judged "$label" "$label"
  else
    tail -n 20 "$work/log"
    miss "builds: $label"
    return
  fi
  test "$TESTS" != no || return
  CFLAGS="$*" sh tests/core/run.sh --cross "$triplet-gcc" "$emulator" > "$work/$label.out" 2>&1
  status=$?
  grep -E 'failed: |failed test|exit status' "$work/$label.out"
  tail -n 1 "$work/$label.out"
  if test $status = 0; then pass "$label: tests/core"
  else miss "$label: tests/core"; fi
}

of arm64 aarch64-linux-gnu aarch64 aarch64
of i386 i686-linux-gnu i386 i386 -msse2 -mfpmath=sse
of armhf arm-linux-gnueabihf arm arm
of ppc64el powerpc64le-linux-gnu ppc64le powerpc64
of s390x s390x-linux-gnu s390x s390x

# x87 arithmetic is refused with the flags to use.
if command -v i686-linux-gnu-gcc > /dev/null 2>&1; then
  if ! i686-linux-gnu-gcc -std=c99 -Isrc/core -fsyntax-only src/core/ground/status.c \
    > "$work/log" 2>&1 && grep -q "needs double precision" "$work/log"; then
    pass "x87 arithmetic is refused"
  else
    miss "x87 arithmetic is refused"
  fi
fi
summary
