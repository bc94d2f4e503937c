#!/usr/bin/env bash
# Builds a preset: build.sh PRESET [TARGET...]. Quiet unless something fails.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
shift
log=$(mktemp)
trap 'rm -f "$log"' EXIT
dir=build
[ "$preset" = release ] || dir=build-$preset
targets=()
[ $# -eq 0 ] || targets=(--target "$@")
if ! { { [ -f "$dir/build.ninja" ] || cmake --preset "$preset"; } &&
  cmake --build "$dir" "${targets[@]}"; } >"$log" 2>&1; then
  cat "$log" >&2
  exit 1
fi
