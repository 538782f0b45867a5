# Sourced by checks in a browser, after common.sh: Chromium and npm's packages.
# shellcheck shell=sh

find_chromium() { command -v chromium || command -v chromium-browser || command -v google-chrome; }

# find_web NAME: leaves $chromium and $web, the folder of playwright-core and axe-core; without a
# browser, node or npm the check NAME ends with exit status 0 and a note.
find_web() {
  name=$1
  skip() { echo "$name: skipped, $*"; exit 0; }
  chromium=$(find_chromium)
  if test -z "$chromium" && command -v apt-get > /dev/null 2>&1 && test "$(id -u)" = 0; then
    apt-get update -qq < /dev/null || true
    # A second time: an installation that lost an archive goes on.
    for time in 1 2; do
      DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends chromium \
        < /dev/null > /dev/null 2>&1 && break
    done
    chromium=$(find_chromium)
  fi
  test -n "$chromium" || skip "Chromium is not installed"
  command -v node > /dev/null 2>&1 || skip "node is not installed"

  web=${ROTDYN_WEB:-${TMPDIR:-/tmp}/rotdyn-web}
  mkdir -p "$web" || exit 1
  if ! test -d "$web/node_modules/playwright-core" || ! test -d "$web/node_modules/axe-core"; then
    command -v npm > /dev/null 2>&1 || skip "npm is not installed"
    (cd "$web" && npm install --no-save --no-audit --no-fund playwright-core axe-core) \
      > "$web/npm.log" 2>&1 || { tail -n 5 "$web/npm.log"; skip "npm installed no packages"; }
  fi
}
