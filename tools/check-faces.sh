#!/bin/sh
# `make check-faces`: the scenes of web/scenes/, one or more of each constraint, through R, the
# command line, the C library from C and from Python, and WebAssembly: the same model for the same
# reasons, natively the same bits (web/tests/faces.mjs). What is not here is skipped with a word.
# Closes with `faces: N passed, N failed, N skipped`.
. "${0%/*}/common.sh"

command -v node > /dev/null 2>&1 || { echo "faces: skipped, node is not installed"; exit 0; }
sh tools/lab-native.sh "$work/native" || exit 1
sh tools/lab.sh wasm "$work/lab.wasm" || exit 1

python=""
if python3 -c "import ctypes" > /dev/null 2>&1; then
  python=python3
  sh tools/library.sh "$work/library" || exit 1
  ROTDYN_LIBRARY=$(ls "$work"/library/lib/librotdyn.so.[0-9] \
    "$work"/library/lib/librotdyn.[0-9].dylib 2> /dev/null | head -n 1)
  export ROTDYN_LIBRARY
fi

r=""
if command -v Rscript > /dev/null 2>&1; then
  mkdir "$work/lib"
  build_tarball "$work" --no-build-vignettes > "$work/install.out" 2>&1 &&
    install_into "$work/lib" >> "$work/install.out" 2>&1 || { cat "$work/install.out"; exit 1; }
  R_LIBS=$work/lib${R_LIBS:+:$R_LIBS} PATH=$work/lib/rotdyn/exec:$PATH
  export R_LIBS
  r=yes
fi

PYTHONPATH=inst/examples/python PYTHON=$python R_FACE=$r LAB_NATIVE=$work/native \
  LAB_WASM=$work/lab.wasm node web/tests/faces.mjs
