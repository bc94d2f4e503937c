#!/usr/bin/env bash
# Renders the small pictures of README.md into docs/images, by path tracing.
#   bench/pictures.sh [DUET]
set -euo pipefail
cd "$(dirname "$0")/.."
duet=${1:-build/duet}

picture() {  # scene file, name, size, method, samples per pixel
  "$duet" render "$1" -q -o "docs/images/$2.png" --size "$3" -i "$4" --spp "$5"
}

for name in cornell-box thesis-modified; do picture "scenes/$name/scene.xml" "$name" 320x320 path 128; done
for name in bsdf-principled bsdf-wrappers depth-of-field lights-delta textures instances; do
  picture "scenes/$name/scene.xml" "$name" 240x180 path 128
done
# Light is scattered within its glass.
picture examples/still-life.pbrt still-life 384x192 volpath 1024
