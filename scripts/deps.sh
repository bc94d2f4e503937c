#!/usr/bin/env bash
# Installs what Duet is built with, if it is missing. Sourced by run.sh and test.sh.
set -euo pipefail

duet_packages=(cmake ninja-build g++ libembree-dev libopenexr-dev libopenimageio-dev libpugixml-dev
  libtinyobjloader-dev libtbb-dev libcli11-dev libfmt-dev nlohmann-json3-dev
  libpng-dev libjpeg62-turbo-dev zlib1g-dev libnanovdb-dev doctest-dev)

# Prints the packages that are not installed.
duet_missing_packages() {
  local package
  for package in "$@"; do
    dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -q '^installed$' ||
      echo "$package"
  done
}

duet_install() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    # Not Debian or Ubuntu: cmake will say what it misses, in terms of these.
    if [ ! -d build ]; then
      echo "This system has no apt-get. Duet needs: a C++20 compiler, CMake 3.25, Ninja, Embree 3.13 or 4," >&2
      echo "OpenEXR 3, OpenImageIO 2.4, libpng, libjpeg, pugixml, tinyobjloader 2, oneTBB, CLI11, fmt," >&2
      echo "nlohmann-json, zlib, NanoVDB and doctest." >&2
    fi
    return 0
  fi
  local missing
  mapfile -t missing < <(duet_missing_packages "$@")
  [ "${#missing[@]}" -gt 0 ] || return 0
  local sudo=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "Please install, as root: apt-get install --no-install-recommends ${missing[*]}" >&2
      return 1
    fi
    sudo=(sudo)
  fi
  echo "Installing ${missing[*]}" >&2
  "${sudo[@]}" apt-get update -qq
  "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
    "${missing[@]}" >/dev/null
}

# The pages of reports are tested in a browser. Where apt has none, which is so on Ubuntu, the tests are told to do
# without; elsewhere they say what they miss.
duet_install_browser() {
  local program
  [ -z "${DUET_BROWSER:-}" ] || return 0
  for program in chromium chromium-browser google-chrome; do
    ! command -v "$program" >/dev/null || return 0
  done
  # No pipe into grep -q: it may end before apt-cache does, and pipefail then takes the package for missing.
  if ! command -v apt-cache >/dev/null || [[ "$(apt-cache policy chromium)" == *"Candidate: "[0-9]* ]]; then
    duet_install chromium
  else
    echo "There is no package chromium: the tests of pages are left out, unless DUET_BROWSER names a browser." >&2
    export DUET_BROWSER=none
  fi
}

duet_install "${duet_packages[@]}"
