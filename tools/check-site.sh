#!/bin/sh
# `make check-site`: builds the site (SITE=: one that is there), then looks at it in Chromium
# (web/tests/site.mjs): accessibility of each kind of page, requests to elsewhere, search, pictures.
# Closes with `site: N passed, N failed`.
cd "$(dirname "$0")/.." || exit 1
. tools/web.sh
find_web site

if test -z "$SITE"; then
  SITE=$(pwd)/site
  sh tools/install.sh --no-build-vignettes && sh tools/site.sh "$SITE" || exit 1
fi
SITE=$SITE CHROMIUM=$chromium WEB=$web node web/tests/site.mjs
