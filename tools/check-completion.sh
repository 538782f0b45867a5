#!/bin/sh
# `make check-completion`: the completions of bash, zsh and fish, each in a shell of its own under a
# terminal: keys are typed, and what the shell writes is read. A shell that is not installed is
# skipped with a word. The last line is `completion: N passed, N failed, N skipped`.
. "${0%/*}/common.sh"

python=""
for name in python3 python; do
  if command -v $name > /dev/null 2>&1; then python=$name; break; fi
done
if test -z "$python"; then
  echo "skip - no Python, which makes the terminal"
  echo "completion: 0 passed, 0 failed, 1 skipped"
  exit
fi
Rscript -e "rotdyn::install_cli('$work/bin')" > "$work/log" 2>&1 || {
  cat "$work/log"
  echo "skip - rotdyn is not installed"
  echo "completion: 0 passed, 0 failed, 1 skipped"
  exit
}
exec "$python" tools/check-completion.py "$work/bin" "$work"
