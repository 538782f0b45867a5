#!/bin/sh
# Tables, metadata, a run, and at least one wrong row for each constraint in SQLite (STRICT tables),
# PostgreSQL (a server of its own, on a socket in a scratch folder) and DuckDB (its npm package),
# and by the metadata check of R. 300 random scenes computed again, and 50 kills while recording.
# The Parquet files of sweeps in nanoparquet and DuckDB, bit for bit.
# What is not installed is named and skipped.
. "${0%/*}/common.sh"

passed=0 failed=0 skipped=0
tally() {
  if test "$1" = 0; then passed=$((passed + 1)); echo "ok - $2"
  else failed=$((failed + 1)); echo "not ok - $2"; fi
}
skip() { skipped=$((skipped + 1)); echo "skipped: $*"; }

mkdir "$work/library"
{ build_tarball "$work" --no-build-vignettes && install_into "$work/library"; } \
  > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
R_LIBS="$work/library:$R_LIBS"
export R_LIBS

# PostgreSQL does not run as root.
as_user=""
if test "$(id -u)" = 0; then as_user="su postgres -s /bin/sh -c"; fi
run_as() { if test -n "$as_user"; then $as_user "$1"; else sh -c "$1"; fi; }

socket=""
binaries=$(dirname "$(command -v initdb || ls -d /usr/lib/postgresql/*/bin/initdb 2> /dev/null |
  tail -1)")
if test -x "$binaries/initdb" &&
  Rscript -e 'quit(status = !requireNamespace("RPostgres", quietly = TRUE))' > /dev/null 2>&1; then
  socket=$(mktemp -d "${TMPDIR:-/tmp}/rotdyn-pg.XXXXXX")
  if test -n "$as_user"; then chown postgres "$socket"; fi
  trap 'run_as "$binaries/pg_ctl -D $socket/data -m immediate stop" > /dev/null 2>&1
    rm -rf "$work" "$socket"' 0
  run_as "$binaries/initdb -D $socket/data -U postgres --auth=trust --no-sync" > "$work/log" 2>&1 &&
    run_as "$binaries/pg_ctl -D $socket/data -w -l $socket/log \
      -o '-k $socket -p 54329 -c listen_addresses= -F' start" >> "$work/log" 2>&1 ||
    { cat "$work/log"; socket=""; tally 1 "a PostgreSQL server starts"; }
else
  skip "PostgreSQL (initdb and RPostgres are needed)"
fi

Rscript tools/databases.R "$work" $socket
tally $? "R, SQLite${socket:+, PostgreSQL}"

Rscript tools/records.R "$work"
tally $? "300 scenes computed again from the database alone; 50 kills"

parts=""
if Rscript -e 'for (name in c("nanoparquet", "yyjsonr")) loadNamespace(name)' > /dev/null 2>&1; then
  mkdir "$work/parts"
  Rscript tools/sweep-parts.R "$work/parts"
  tally $? "parts of sweeps by nanoparquet"
  test -f "$work/parts/sweep-parts.json" && parts=yes
else
  skip "parts of sweeps (the packages nanoparquet and yyjsonr are needed)"
fi

if command -v node > /dev/null && command -v npm > /dev/null &&
  (cd "$work" && npm install --no-audit --no-fund @duckdb/node-api > npm.log 2>&1); then
  node tools/databases.js "$work"
  tally $? "DuckDB"
  if test -n "$parts"; then
    node tools/sweep-parts.js "$work/parts" "$work"
    tally $? "parts of sweeps by DuckDB"
  fi
else
  skip "DuckDB (node, npm and its package @duckdb/node-api are needed)"
fi

echo "databases: $passed passed, $failed failed, $skipped skipped"
test $failed = 0
