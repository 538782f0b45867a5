#!/bin/sh
# Sweeps in folders whose processes are killed at random moments: two daemons and their coordinator,
# or two jobs of an array. The result has the same bits, no committed chunk is computed again, a
# kill costs a chunk for each worker, and nothing stays in work/.
#
#   tools/kill-sweep.sh [KILLS [SEED]]
. "${0%/*}/common.sh"

test -d /proc/self || { echo "skipped: the processes are followed by /proc"; exit 0; }
for package in mirai nanoparquet yyjsonr; do
  Rscript -e "quit(status = !requireNamespace('$package', quietly = TRUE))" > /dev/null 2>&1 ||
    { echo "skipped: the package $package is needed"; exit 0; }
done

mkdir "$work/library"
{ build_tarball "$work" --no-build-vignettes && install_into "$work/library"; } \
  > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
R_LIBS="$work/library:$R_LIBS"
export R_LIBS

# Each process that the check starts has this folder's name in its environment, and a file of its
# number there. What is left of them ends with the script.
ROTDYN_KILL_STATE=$work/state
mkdir "$ROTDYN_KILL_STATE" "$ROTDYN_KILL_STATE/pids"
export ROTDYN_KILL_STATE
trap 'sh tools/end-processes.sh "$ROTDYN_KILL_STATE"; rm -rf "$work"' 0

# R of the command line, with the log of chunks.
cat > "$work/R-with-log" << EOF
#!/bin/sh
exec R -e 'source("$top/tools/kill-sweep-profile.R")' "\$@"
EOF
chmod +x "$work/R-with-log"

Rscript tools/kill-sweep.R "$work" "${1:-30}" "${2:-1}"
