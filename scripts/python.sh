#!/usr/bin/env bash
# Builds the Python package, installs it into build-python/venv and tests it there against the program, which has to
# be built (scripts/test.sh). nanobind, scikit-build-core and numpy come from PyPI.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/deps.sh
duet_install python3-dev python3-venv
[ -d build-python/venv ] || python3 -m venv build-python/venv
. build-python/venv/bin/activate
pip --quiet install "nanobind>=2.1" "scikit-build-core>=0.10" numpy
pip --quiet install --no-build-isolation -C build-dir=build-python/cmake .
DUET_PROGRAM=${DUET_PROGRAM:-$PWD/build/duet} python -W error -m unittest discover -s tests/python
