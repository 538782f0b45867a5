#!/bin/sh
# Lessons and articles as a reader gets them: built with the packages that the README installs and
# no others, every output and picture there, and in headless Chromium width, contrast, texts of
# pictures.
#
#   tools/check-lessons.sh [FOLDER of built pages]
#
# ROTDYN_WEB as in check-animations.sh; SHOTS: a folder for pictures of the pages at 400 px.
. "${0%/*}/common.sh"
. tools/web.sh

pages=$1
if test -z "$pages"; then
  sh tools/setup.sh demo || exit 1
  # A library of links to what README names and what that needs.
  mkdir "$work/only"
  Rscript - "$work/only" $(Rscript tools/setup.R imports) $(Rscript tools/setup.R lessons) << 'END'
args <- commandArgs(TRUE)
all <- installed.packages()
base <- rownames(all)[all[, "Priority"] %in% "base"]
needed <- tools::package_dependencies(args[-1L], all, recursive = TRUE)
needed <- setdiff(c(args[-1L], unlist(needed)), base)
invisible(file.symlink(find.package(intersect(unique(needed), rownames(all))), args[1L]))
END
  R_LIBS=$work/only R_LIBS_SITE=$work/only R_LIBS_USER=$work/only
  export R_LIBS R_LIBS_SITE R_LIBS_USER
  build_tarball "$work" > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
  tar xzf "$tarball" -C "$work" || exit 1
  pages=$work/rotdyn/inst/doc
fi
status=0
Rscript tools/lessons.R vignettes "$pages" || status=1
find_web pages
CHROMIUM=$chromium WEB=$web PAGES=$pages node tools/lessons.mjs > "$work/log" || status=1
grep -v '^ok' "$work/log"
exit $status
