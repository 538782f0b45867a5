#!/bin/sh
# Installs the package from this tree into the first R library that can be written.
. "${0%/*}/common.sh"

library=$(Rscript tools/setup.R library) || exit 1
{ build_tarball "$work" --no-build-vignettes && install_into "$library"; } > "$work/log" 2>&1 ||
  { cat "$work/log"; echo "install: failed"; exit 1; }
echo "install: $(basename "$tarball" .tar.gz) is in $library"
