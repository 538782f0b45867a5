#!/bin/sh
# Installs what a verb of the Makefile needs and this machine does not have.
#
#   tools/setup.sh demo|test|bench|coverage|document|site|valgrind|manual|format|architectures|lab
#
# System packages come from apt-get, if it exists and the user is root; otherwise the script prints
# the command to type. R packages come as Debian's r-cran-* where R uses Debian's library, and from
# CRAN otherwise. R itself reports which packages it can load, before and after. A need is either
# essential (without it: exit 1) or optional (without it: a note; later steps skip what uses it).

cd "$(dirname "$0")/.." || exit 1
group=$1

# make calls this script; a make that R starts must not inherit its flags.
unset MAKEFLAGS MFLAGS MAKELEVEL

have() { command -v "$1" > /dev/null 2>&1; }
say() { echo "setup: $*"; }

debian_lib=/usr/lib/R/site-library
can_apt=no
if have apt-get && test "$(id -u)" = 0; then can_apt=yes; fi

# ---- system ---------------------------------------------------------------------------------

# GSL's headers, wherever configure would look for them.
has_gsl() {
  for flags in "$GSL_CFLAGS" "${INCLUDE_DIR:+-I$INCLUDE_DIR}" "$(pkg-config --cflags gsl 2>&1)" \
    "$(gsl-config --cflags 2>&1)" ""; do
    # shellcheck disable=SC2086
    echo "#include <gsl/gsl_odeiv2.h>" | ${CC:-cc} -E $flags - > /dev/null 2>&1 && return 0
  done
  return 1
}

has_compiler() { have cc && have make; }
has_r() { have R && have Rscript; }
has_clang_sanitizer() {
  have clang && echo "int main(void) { return 0; }" |
    clang -fsanitize=address,undefined -x c - -o /dev/null > /dev/null 2>&1
}
has_wasi() {
  have clang && have wasm-ld && echo "int main(void) { return 0; }" |
    clang --target=wasm32-wasi -x c - -o /dev/null > /dev/null 2>&1
}
has_scipy() {
  for python in python3 /usr/bin/python3; do
    $python -c "import scipy.integrate" > /dev/null 2>&1 && return 0
  done
  return 1
}

# The run-time of clang's sanitizers is in a package of its own, with clang's version in its name.
clang_rt() {
  major=$(apt-cache depends clang 2> /dev/null | sed -n 's/.*Depends: clang-\([0-9]*\).*/\1/p')
  echo "libclang-rt-${major:-14}-dev"
}

# need essential|optional TEST NAME DEBIAN FEDORA BREW ("-": no package)
essential="" optional="" apt_list="" dnf_list="" brew_list=""
need() {
  case $2 in
    has_*) "$2" && return ;;
    *) have "$2" && return ;;
  esac
  eval "$1=\"\${$1}, $3\""
  test "$4" = - || apt_list="$apt_list $4"
  test "$5" = - || dnf_list="$dnf_list $5"
  test "$6" = - || brew_list="$brew_list $6"
}

system_needs() {
  essential="" optional="" apt_list="" dnf_list="" brew_list=""
  case $group in demo | test | bench | coverage | document | site | valgrind | manual)
    need essential has_r "R" "r-base-core r-base-dev" "R-core-devel" r
    need essential has_compiler "a C compiler and make" build-essential "gcc make" -
    need essential has_gsl "GNU GSL" libgsl-dev gsl-devel gsl
  esac
  case $group in
    demo) need optional pandoc pandoc pandoc pandoc pandoc ;;
    test)
      need optional pandoc pandoc pandoc pandoc pandoc
      need optional qpdf qpdf qpdf qpdf qpdf
      need optional tidy "HTML tidy" tidy tidy tidy-html5
      need optional checkbashisms checkbashisms devscripts devscripts-checkbashisms checkbashisms
      need optional clang clang clang clang llvm
      need optional clang-format clang-format clang-format clang-tools-extra clang-format
      need optional has_clang_sanitizer "clang's sanitizers" "$(clang_rt)" compiler-rt -
      ;;
    site)
      need essential pandoc pandoc pandoc pandoc pandoc
      need essential npm npm npm npm node
      ;;
    bench) need optional has_scipy "Python's scipy" python3-scipy python3-scipy scipy ;;
    valgrind) need essential valgrind valgrind valgrind valgrind valgrind ;;
    architectures)
      need essential has_compiler "a C compiler and make" build-essential "gcc make" -
      while read -r triplet debian; do
        need optional "$triplet-gcc" "the compiler of $debian" \
          "gcc-$triplet libc6-dev-$debian-cross" - -
      done << LIST
aarch64-linux-gnu arm64
i686-linux-gnu i386
arm-linux-gnueabihf armhf
powerpc64le-linux-gnu ppc64el
s390x-linux-gnu s390x
LIST
      need optional qemu-s390x-static "qemu's user mode" qemu-user-static qemu-user-static -
      ;;
    lab)
      need essential clang clang clang clang llvm
      need essential wasm-ld lld lld lld lld
      need essential has_wasi "wasi-libc and clang's run-time for wasm32" \
        "wasi-libc $(clang_rt)-wasm32" "wasi-libc-static compiler-rt-wasm32" wasi-libc
      need essential wasm-opt wasm-opt binaryen binaryen binaryen
      need essential node node nodejs nodejs node
      ;;
    format) need essential clang-format clang-format clang-format clang-tools-extra clang-format ;;
    manual)
      # LaTeX is large, so the user installs it.
      if ! have pdflatex; then
        say "LaTeX is not installed. The manual needs it:"
        say "  Debian, Ubuntu   apt-get install texlive-latex-recommended \\"
        say "                     texlive-fonts-extra texinfo"
        say "  Fedora           dnf install texlive-scheme-medium texlive-inconsolata"
        say "  macOS            brew install --cask mactex-no-gui"
        exit 1
      fi
      ;;
  esac
}

updated=no
apt_update() {
  test $updated = yes && return
  updated=yes
  apt-get update -qq -o DPkg::Lock::Timeout=300 < /dev/null || say "apt-get update failed"
}

# apt-get installs nothing if it does not know one of the names, so unknown names are left out.
apt_install() {
  apt_update
  known=""
  for name in "$@"; do
    apt-cache show "$name" > /dev/null 2>&1 && known="$known $name"
  done
  test -n "$known" || return 0
  say "apt-get install$known"
  # shellcheck disable=SC2086
  DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
    -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 $known < /dev/null > "$log" 2>&1 ||
    { tail -n 20 "$log"; say "apt-get did not succeed"; }
}

# ---- R packages -----------------------------------------------------------------------------

ask_r() { Rscript tools/setup.R "$@" < /dev/null; }

# Some CRAN packages need a system library to build: av, units, png, rgl, xml2 (for roxygen2)
# and fs, on which the others named here depend. Without that library fs builds its own copy, if
# cmake is installed.
from_cran() {
  extra=""
  have g++ && have gfortran || extra="r-base-dev"
  for name in "$@"; do
    case $name in
      av) extra="$extra libavfilter-dev" ;;
      units) extra="$extra libudunits2-dev" ;;
      png) extra="$extra libpng-dev" ;;
      rgl) extra="$extra libfreetype6-dev libgl1-mesa-dev libglu1-mesa-dev libpng-dev" ;;
      xml2) extra="$extra libxml2-dev pkg-config" ;;
      roxygen2) extra="$extra libxml2-dev libuv1-dev pkg-config" ;;
      testthat | rmarkdown | pkgbuild) extra="$extra libuv1-dev pkg-config" ;;
    esac
  done
  # shellcheck disable=SC2086
  if test $can_apt = yes && test -n "$extra"; then apt_install $extra; fi
  if ! { have pkg-config && pkg-config --exists libuv; }; then
    USE_BUNDLED_LIBUV=1
    export USE_BUNDLED_LIBUV
  fi
  say "from CRAN: $*"
  ask_r install "$@" > "$log" 2>&1
}

# ---- go -------------------------------------------------------------------------------------

case $group in
  demo | test | bench | coverage | document | site | valgrind | manual | format) ;;
  architectures | lab) ;;
  *) sed -n '2,4s/^# *//p' "$0"; exit 2 ;;
esac

log=$(mktemp "${TMPDIR:-/tmp}/rotdyn-setup.XXXXXX") || exit 1
trap 'rm -f "$log"' 0
trap 'exit 1' HUP INT TERM

system_needs
if test -n "$apt_list" && test $can_apt = yes; then
  # shellcheck disable=SC2086
  apt_install $apt_list
  system_needs
fi
if test -n "$essential$optional"; then
  test -z "$optional" || say "not installed, so what uses them is skipped: ${optional#, }"
  test -z "$essential" || say "MISSING: ${essential#, }"
  say "they come with one of"
  test -z "$apt_list" || say "  apt-get install$apt_list"
  test -z "$dnf_list" || say "  dnf install$dnf_list"
  test -z "$brew_list" || say "  brew install$brew_list"
  test -z "$essential" || exit 1
fi

# R packages, essential and optional.
case $group in format | architectures | lab) exit 0 ;; esac
must=$(ask_r imports) || exit 1
may=""
case $group in
  # lpSolve judges structures at rest (bench/coverage/statics.R).
  coverage) may="lpSolve" ;;
  demo) may=$(ask_r lessons) ;;
  test | bench) must="$must testthat"; may=$(ask_r suggests) ;;
  # roxygen2 loads the package from its sources; pkgbuild compiles them.
  document) must="$must roxygen2 pkgbuild" ;;
  site) must="$must pkgdown"; may=$(ask_r lessons) ;;
esac

# shellcheck disable=SC2086
{
  missing=$(ask_r missing $must $may) || exit 1
  if test -n "$missing" && test $can_apt = yes &&
    Rscript -e "quit(status = !('$debian_lib' %in% .libPaths()))"; then
    apt_install $(for name in $missing; do echo "r-cran-$name"; done | tr '[:upper:]' '[:lower:]')
    missing=$(ask_r missing $missing)
  fi
  if test -n "$missing"; then
    from_cran $missing
    missing=$(ask_r missing $missing)
    # install.packages() only warns: its last lines give the reason.
    if test -n "$missing"; then
      tail -n 30 "$log"
      test -z "$extra" || say "they may need these first (Debian's names): $extra"
    fi
  fi
  status=0
  for name in $missing; do
    case " $(echo $must) " in
      *" $name "*) say "MISSING: the R package $name"; status=1 ;;
      *) say "not available, so what uses it is skipped: the R package $name" ;;
    esac
  done
}
test $status = 0 && say "everything needed for '$group' is here"
exit $status
