#!/usr/bin/env bash
# Builds Duet with its tests and runs them. Arguments go to ctest (for example -L fast).
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/deps.sh
scripts/build.sh release
exec ctest --test-dir build --output-on-failure "$@"
