#!/usr/bin/env bash
# Makes the charts of README.md and docs/charts.md: docs/images/chart-SCENE.svg. Wants a release build and a
# machine with nothing else to do.
#   bench/charts.sh [DUET [TIME]]
set -euo pipefail
cd "$(dirname "$0")/.."
duet=${1:-build/duet} time=${2:-60s}
scenes=(thesis-empty thesis-modified cornell-box lights-delta)

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
files=()
for scene in "${scenes[@]}"; do files+=("scenes/$scene/scene.xml"); done
"$duet" chart "${files[@]}" -i path,bdpt,vcm --time "$time" -o "$folder" \
  --reference 'reference/{folder}/mean.exr' --variance 'reference/{folder}/variance.exr'
for scene in "${scenes[@]}"; do cp "$folder/$scene/chart.svg" "docs/images/chart-$scene.svg"; done
cat "$folder/summary.csv"
