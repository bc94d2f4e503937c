#!/usr/bin/env bash
# Makes a Debian package of the release build: build/duet_VERSION_ARCHITECTURE.deb.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/deps.sh
duet_install dpkg-dev file
scripts/build.sh release duet duet_shell_files
cd build
rm -f duet_*.deb
cpack -G DEB >/dev/null
ls "$PWD"/duet_*.deb
