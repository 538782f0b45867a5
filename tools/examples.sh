#!/bin/sh
# Builds and runs the programs of inst/examples in every language whose compiler is here, and
# compares what they print with R, to the last bit. Builds the library first.
#
#   tools/examples.sh     a line for each; the last is `examples: N passed, N failed, N skipped`
#
# With R: the example package passes R CMD check, too.

. "${0%/*}/common.sh"

library=$work/library
sh tools/library.sh "$library" || exit 1
# So that the loader finds it, under Linux and macOS.
LD_LIBRARY_PATH=$library/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
DYLD_LIBRARY_PATH=$library/lib${DYLD_LIBRARY_PATH:+:$DYLD_LIBRARY_PATH}
# The name that programs link: librotdyn.so.1, librotdyn.1.dylib.
ROTDYN_LIBRARY=$(ls "$library"/lib/librotdyn.so.[0-9] "$library"/lib/librotdyn.[0-9].dylib \
  2> /dev/null | head -n 1)
export LD_LIBRARY_PATH DYLD_LIBRARY_PATH ROTDYN_LIBRARY

passed=0 failed=0 skipped=0
pass() { passed=$((passed + 1)); echo "ok - $1"; }
fail() { failed=$((failed + 1)); echo "not ok - $1"; }
skip() { skipped=$((skipped + 1)); echo "skip - $1"; }
first_of() { for tool; do command -v "$tool" && return; done; }

# Whether R can compare: the package is installed, or is installed now.
if ! command -v Rscript > /dev/null 2>&1; then
  compare=no
  echo "R is not here: the programs are built and run, and not compared"
else
  compare=yes
  mkdir "$work/lib"
  build_tarball "$work" --no-build-vignettes > "$work/install.out" 2>&1 &&
    install_into "$work/lib" >> "$work/install.out" 2>&1 ||
    { cat "$work/install.out"; fail "rotdyn does not install"; compare=no; }
  R_LIBS=$work/lib${R_LIBS:+:$R_LIBS}
  export R_LIBS
fi

# check NAME COMMAND...: runs the program; tools/examples.R computes the same in R.
check() {
  name=$1
  shift
  if ! "$@" > "$work/$name.csv" 2> "$work/$name.err"; then
    cat "$work/$name.err"
    fail "$name runs"
  elif test $compare = no; then
    pass "$name runs, not compared"
  elif Rscript tools/examples.R "$name" "$work/$name.csv"; then
    pass "$name prints R's numbers"
  else
    fail "$name prints R's numbers"
  fi
}

# built NAME COMMAND...: compiles.
built() {
  name=$1
  shift
  "$@" > "$work/$name.log" 2>&1 && return
  cat "$work/$name.log"
  fail "$name compiles"
  return 1
}

here=inst/examples
use="-I$library/include -L$library/lib"
warn="-Wall -Wextra -Wpedantic -Werror"
# shellcheck disable=SC2086
{
  built c ${CC:-cc} -std=c99 $warn $use $here/c/rolling.c -lrotdyn -o "$work/rolling" &&
    check c "$work/rolling"
  built c-precession ${CC:-cc} -std=c99 $warn $use $here/c/precession.c -lrotdyn \
    -o "$work/precession" && check c-precession "$work/precession"
  built c-drive ${CC:-cc} -std=c99 $warn $use $here/c/drive.c -lrotdyn -o "$work/drive" &&
    check c-drive "$work/drive"
  # The static library, with the same program.
  libs=$(sed -n 's/^Libs.private: //p' "$library/lib/pkgconfig/rotdyn.pc")
  built c-static ${CC:-cc} -std=c99 -I"$library/include" $here/c/rolling.c \
    "$library/lib/librotdyn.a" $libs -o "$work/rolling-static" &&
    check c-static "$work/rolling-static"

  cxx=${CXX:-$(first_of c++ g++ clang++)}
  if test -z "$cxx"; then skip "cpp: there is no C++ compiler"
  elif built cpp $cxx -std=c++11 $warn $use $here/cpp/spin_up.cpp -lrotdyn -o "$work/spin_up"; then
    check cpp "$work/spin_up"
  fi

  fc=${FC:-$(first_of gfortran flang ifx)}
  if test -z "$fc"; then skip "fortran: there is no gfortran"
  elif built fortran $fc -J"$work" $use $here/fortran/inertia.f90 -lrotdyn -o "$work/inertia"; then
    check fortran "$work/inertia"
  fi

  if ! rustc --version > /dev/null 2>&1; then skip "rust: there is no rustc"
  elif built rust rustc --edition 2021 -O -L "$library/lib" -o "$work/sweep" \
    $here/rust/sweep.rs; then
    check rust "$work/sweep"
  fi

  if ! python3 -c "import ctypes" > /dev/null 2>&1; then skip "python: there is no python3"
  else
    check python python3 $here/python/pendulum.py
    check python-scenes python3 $here/python/scenes.py
  fi

  if ! julia --version > /dev/null 2>&1; then skip "julia: there is no julia"
  else check julia julia $here/julia/energies.jl
  fi
}

if test $compare = no; then
  skip "linkingto, two copies of the core: need R"
else
  # The static library inside R, where the package has the core, too.
  cat > "$work/copy.c" <<'C'
#include <rotdyn.h>
void copy(double *time_s, double *omega) {
  static const char *const name = "omega_rad_per_s";
  rotdyn_object *scene = rotdyn_object_new("scene_axle");
  rotdyn_object *resistance = rotdyn_object_new("resistance");
  (void)rotdyn_set_number(resistance, "viscous_n_m_s", 0.1);
  (void)rotdyn_set_number(resistance, "quadratic_n_m_s2", 0.25);
  (void)rotdyn_set_number(scene, "body", 0.5);
  (void)rotdyn_set_number(scene, "omega0_rad_per_s", 3.0);
  (void)rotdyn_set_object(scene, "resistance", resistance);
  (void)rotdyn_scene_run(scene, 1, time_s, (const rotdyn_options *)0, 1, 1, &name, &omega,
                         (rotdyn_report *)0);
  rotdyn_object_free(resistance);
  rotdyn_object_free(scene);
}
C
  cat > "$work/copy.R" <<'R'
library(rotdyn)
ours <- function() {
  scene <- scene_axle(0.5, NULL, resistance(0.1, 0.25), omega0_rad_per_s = 3)
  trajectory(scene, 8)$omega_rad_per_s
}
before <- ours()
dyn.load(paste0("copy", .Platform$dynlib.ext))
theirs <- .C("copy", 8, 0)[[2]]
stopifnot(identical(before, theirs), identical(before, ours()))
R
  if (cd "$work" && PKG_CPPFLAGS="-I$library/include" PKG_LIBS="$library/lib/librotdyn.a $libs" \
    R CMD SHLIB copy.c && Rscript copy.R) > "$work/copy.out" 2>&1; then
    pass "two copies of the core in one process"
  else
    cat "$work/copy.out"
    fail "two copies of the core in one process"
  fi

  (cd "$work" && R CMD build "$top/$here/linkingto" > check.out 2>&1 &&
    _R_CHECK_CRAN_INCOMING_=false R CMD check --no-manual rotdynclient_*.tar.gz >> check.out 2>&1)
  if grep -q '^Status: OK' "$work/check.out"; then
    pass "linkingto passes R CMD check"
  else
    cat "$work/check.out"
    fail "linkingto passes R CMD check"
  fi
fi

echo "examples: $passed passed, $failed failed, $skipped skipped"
test $failed = 0
