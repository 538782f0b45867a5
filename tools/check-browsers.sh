#!/bin/sh
# `make check-browsers`: the page of the lab in Firefox and WebKit, its numbers beside Chromium's
# (web/tests/browsers.mjs). What is not installed is skipped with a word; with apt-get and rights to
# use it, Firefox and WebKitGTK with their drivers are installed. SHOTS: a folder for pictures.
# The last line is `browsers: N passed, N failed, N skipped`.

cd "$(dirname "$0")/.." || exit 1
. tools/web.sh
find_web browsers

test -d "$web/node_modules/puppeteer-core" ||
  (cd "$web" && npm install --no-save --no-audit --no-fund puppeteer-core playwright-core \
    axe-core) > "$web/npm.log" 2>&1 || { tail -n 5 "$web/npm.log"; skip "npm: no puppeteer-core"; }

find_firefox() { command -v firefox-esr || command -v firefox; }
# The small browser is below a folder of the architecture.
find_minibrowser() {
  command -v MiniBrowser || find /usr/lib /usr/libexec -name MiniBrowser -type f 2> /dev/null |
    sort | tail -n 1
}
lacking=""
test -n "$(find_firefox)" || lacking="$lacking firefox-esr"
command -v WebKitWebDriver > /dev/null 2>&1 || lacking="$lacking webkit2gtk-driver"
command -v xvfb-run > /dev/null 2>&1 || lacking="$lacking xvfb"
if test -n "$lacking" && command -v apt-get > /dev/null 2>&1 && test "$(id -u)" = 0; then
  # shellcheck disable=SC2086
  DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $lacking \
    < /dev/null > /dev/null 2>&1 || echo "browsers: apt-get did not install$lacking"
fi
webkit=""
if command -v xvfb-run > /dev/null 2>&1; then webkit=$(command -v WebKitWebDriver); fi

CHROMIUM=$chromium FIREFOX=$(find_firefox) WEBKIT=$webkit MINIBROWSER=$(find_minibrowser) \
  WEB=$web SHOTS=$SHOTS node web/tests/browsers.mjs
