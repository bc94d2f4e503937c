#!/usr/bin/env bash
# What is asked of the sources beside that they compile: their format (clang-format 14), which headers include which,
# and the size of functions.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/deps.sh
duet_install clang-format-14 python3
find src parsers tests bench -name '*.h' -o -name '*.cpp' | xargs -P "$(nproc)" -n 50 clang-format-14 --dry-run --Werror
scripts/check_includes.sh
scripts/check_functions.py
