#!/usr/bin/env bash
# Renders the small pictures of README.md into docs/images, by path tracing with 128 samples per pixel.
#   bench/pictures.sh [DUET]
set -euo pipefail
cd "$(dirname "$0")/.."
duet=${1:-build/duet}

picture() {  # scene file, name, size, further options
  local scene=$1 name=$2 size=$3
  shift 3
  "$duet" render "$scene" -q --spp 128 --size "$size" -o "docs/images/$name.png" "$@"
}

for name in cornell-box thesis-modified; do picture "scenes/$name/scene.xml" "$name" 320x320 -i path; done
for name in bsdf-principled bsdf-wrappers depth-of-field lights-delta textures instances; do
  picture "scenes/$name/scene.xml" "$name" 240x180 -i path
done
# Light is scattered within its glass.
picture examples/still-life.pbrt still-life 384x192 -i volpath
