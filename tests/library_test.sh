#!/usr/bin/env bash
# Builds the C++ library, shared and then static, installs it into an empty folder, and builds and runs examples/cpp
# against it with g++ and clang. The program, built already, makes the same image: library_test.sh PROGRAM [FOLDER]
set -euo pipefail
program=$(realpath "$1")
cd "$(dirname "$0")/.."
. scripts/deps.sh
duet_install clang-14
root=$PWD
mkdir -p "${2:-build-library}"
folder=$(realpath "${2:-build-library}")

# install_library ON|OFF: shared or static. What users have of a build folder is what was installed.
install_library() {
  cmake -S . -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DDUET_LIBRARY=ON -DBUILD_SHARED_LIBS="$1" \
    -DDUET_BUILD_TESTS=OFF >/dev/null
  cmake --build "$folder/build" >/dev/null
  rm -rf "$folder/installed"
  cmake --install "$folder/build" --prefix "$folder/installed" >/dev/null
  sed -i 's/A white ball under/An installed ball under/' "$folder/installed/share/duet/stability/catalogue.json"
}

# use_library COMPILER
use_library() {
  local examples=$folder/examples-$1
  rm -rf "$examples"
  cmake -S "$root/examples/cpp" -B "$examples" -DCMAKE_CXX_COMPILER="$1" \
    -DCMAKE_PREFIX_PATH="$folder/installed" >/dev/null
  cmake --build "$examples" >/dev/null
  cd "$folder"
  "$examples/render" "$root/scenes/textures/scene.xml" library.exr 2
  "$program" "$root/scenes/textures/scene.xml" -i auto --spp 2 -o program.exr -q
  "$program" compare library.exr program.exr --require 'rmse<1e-12' >/dev/null
  "$examples/progress" | tail -n 1
  "$examples/compare" "$root/scenes/cornell-box/scene.xml" chart.html table.html >compare.txt
  grep -q '"relrmse"' compare.txt
  grep -q 'accuracy against time' chart.html
  cd "$root"
}

# The headers have no macros and are few.
[ "$(ls src/library/duet/*.h | wc -l)" -le 12 ]
if grep -n '#define' src/library/duet/*.h; then exit 1; fi

install_library ON
for compiler in g++ clang++-14; do
  use_library "$compiler"
  # The catalogue is the one that was installed with the library.
  grep -q 'An installed ball' "$folder/table.html"
done
# Nothing but the functions and classes of the headers is to be seen from outside.
inner=$(nm -DC --defined-only "$(find "$folder/installed" -name libduet.so)" |
  grep -E ' T .*(Embree|PathIntegrator)' || true)
[ -z "$inner" ] || { echo "$inner" >&2 && exit 1; }

install_library OFF
archive=$(find "$folder/installed" -name 'libduet.*')
[ "$(basename "$archive")" = libduet.a ] || { echo "not a static library alone: $archive" >&2 && exit 1; }
# Objects that only the compiler that made them can link have such sections.
if readelf -SW "$archive" | grep -m 1 '\.gnu\.lto_'; then exit 1; fi
for compiler in g++ clang++-14; do
  use_library "$compiler"
  if ldd "$folder/examples-$compiler/render" | grep libduet; then exit 1; fi
done
echo "3 programs with 2 compilers ran on the installed library, shared and static"
