#!/bin/sh
# Makes inst/lab/lab.html from web/ and the core: the core by clang for WebAssembly, the page by
# node.
#
#   tools/lab.sh [wasm FILE]     with `wasm`: the core alone, as FILE
#
# Needs clang, lld, wasi-libc, the run-time of clang for wasm32, wasm-opt and node: `tools/setup.sh
# lab`. Neither GSL nor R.

cd "$(dirname "$0")/.." || exit 1
work=$(mktemp -d "${TMPDIR:-/tmp}/rotdyn-lab.XXXXXX") || exit 1
trap 'rm -rf "$work"' 0
trap 'exit 1' HUP INT TERM

fail() { echo "lab: $*" >&2; exit 1; }
for tool in clang wasm-ld wasm-opt node; do
  command -v $tool > /dev/null 2>&1 || fail "$tool is not installed: tools/setup.sh lab"
done

# Without the parts that no motion needs: fits, sweeps, designs, measured motions.
find src/core web/core -name '*.c' | LC_ALL=C sort |
  grep -vE '^src/core/(fit|sweep|summary|design|measure)/|trust_region|body/density' > "$work/files"

# By size: 756 kB of WebAssembly, where -O2 makes 885 (the length of what `wasm FILE` writes).
flags="--target=wasm32-wasi -Os -std=c99 -ffp-contract=off -fvisibility=hidden -DNDEBUG
  -ffunction-sections -fdata-sections -Isrc/core -Iinst/include -Iweb/core/few
  -D_WASI_EMULATED_PROCESS_CLOCKS"
jobs=$(getconf _NPROCESSORS_ONLN 2> /dev/null || echo 1)
# shellcheck disable=SC2086
xargs -P "$jobs" -I{} sh -c 'file=$1 dir=$2; shift 2
  "$@" -c "$file" -o "$dir/$(echo "${file%.c}" | tr / -).o"' \
  build {} "$work" clang $flags < "$work/files" || fail "the core does not compile"

objects=$(sed 's|\.c$|.o|; s|/|-|g' "$work/files" | sed "s|^|$work/|")
# shellcheck disable=SC2086
clang --target=wasm32-wasi -mexec-model=reactor -Wl,--gc-sections -Wl,--strip-all -Wl,-O2 \
  -Wl,-z,stack-size=1048576 $objects -lwasi-emulated-process-clocks -o "$work/linked.wasm" ||
  fail "the link"
wasm-opt -Os --strip-debug --strip-producers "$work/linked.wasm" -o "$work/lab.wasm" ||
  fail "wasm-opt"
if test "$1" = wasm; then
  cp "$work/lab.wasm" "$2" || exit 1
  exit 0
fi
# GNU gzip writes the same bytes everywhere; the zlib of node does not.
gzip -9n "$work/lab.wasm" && mkdir -p inst/lab &&
  node tools/lab.mjs "$work/lab.wasm.gz" inst/lab/lab.html
