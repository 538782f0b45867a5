#!/bin/sh
# Builds the site of the package in site/: pkgdown, the lab at lab/, formulas as MathML. No page
# asks anybody for anything. Needs pkgdown, pandoc and npm; pkgdown itself stays offline.
#
#   tools/site.sh [FOLDER] [ARTICLES]    ARTICLES: only those of these names, such as "rotdyn hoop"

cd "$(dirname "$0")/.." || exit 1
site=${1:-site}
case $site in /*) ;; *) site=$(pwd)/$site ;; esac
fail() { echo "site: $*" >&2; exit 1; }
for tool in Rscript pandoc npm; do
  command -v $tool > /dev/null 2>&1 || fail "$tool is not installed"
done
Rscript -e 'quit(status = !requireNamespace("pkgdown", quietly = TRUE))' ||
  fail "the R package pkgdown is not installed"

web=${ROTDYN_WEB:-${TMPDIR:-/tmp}/rotdyn-web}-site
mkdir -p "$web" "$site" || exit 1
test -d "$web/node_modules/mark.js" || (npm install --prefix "$web" --no-save --no-audit --no-fund \
  clipboard@2.0.6 fuse.js@6.4.6 autocomplete.js@0.38.0 mark.js@8.11.1) > "$web/npm.log" 2>&1 ||
  { tail -n 5 "$web/npm.log"; fail "npm installed no packages"; }

Rscript tools/site.R "$site" "$2" || fail "pkgdown"

mkdir -p "$site/deps/site" "$site/lab" || exit 1
from=$web/node_modules
cp "$from/clipboard/dist/clipboard.min.js" "$from/fuse.js/dist/fuse.js" \
  "$from/autocomplete.js/dist/autocomplete.jquery.min.js" "$from/mark.js/dist/mark.min.js" \
  tools/site/site.js tools/site/site.css "$site/deps/site/" || exit 1
cp inst/lab/lab.html "$site/lab/" || exit 1

# Nothing that a page loads by itself is elsewhere.
asks=$(grep -rlE '<(script|link|img|iframe)[^>]*(src|href)="(https?:)?//' "$site" \
  --include='*.html')
test -z "$asks" || { echo "$asks"; fail "these pages load from elsewhere"; }
echo "site: $(find "$site" -name '*.html' | wc -l | tr -d ' ') pages in $site"
