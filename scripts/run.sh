#!/usr/bin/env bash
# Builds Duet and runs it with the given arguments. Without arguments it renders scenes/cornell-box,
# writes an EXR and a PNG, and compares the image with the reference.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)

(
  cd "$root"
  [ -x build/duet ] || echo "Building Duet; this takes a few minutes the first time." >&2
  . scripts/deps.sh
  scripts/build.sh release duet
)
if [ $# -gt 0 ]; then
  exec "$root/build/duet" "$@"
fi
# As large as the reference, and with samples enough for the z-test, which takes noise to be normal.
"$root/build/duet" render "$root/scenes/cornell-box/scene.xml" -D size=128 --spp 256 \
  -o cornell-box.exr -o cornell-box.png
"$root/build/duet" compare cornell-box.exr "$root/reference/cornell-box/mean.exr" \
  --variance "$root/reference/cornell-box/variance.exr" --require 'bias<4'
