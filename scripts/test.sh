#!/usr/bin/env bash
# Builds Duet with its tests and runs them, without the slow ones. Arguments go to ctest instead (for
# example -L fast, or -L slow).
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/deps.sh
duet_install_browser
scripts/build.sh release
[ $# -gt 0 ] || set -- -LE slow
exec ctest --test-dir build --output-on-failure "$@"
