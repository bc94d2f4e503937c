#!/usr/bin/env bash
# What takes too long for .ci/run. nightly.sh runs all stages, and takes hours; nightly.sh STAGE... runs those
# named; nightly.sh --list says which there are. A stage that fails does not stop the next one.
#   DUET_FUZZ_SECONDS   how long every fuzzer runs (120)
# Logs go to build-nightly/. The table in docs/nightly.md has the last run of every stage. Exits with 1 if a
# stage failed.
set -euo pipefail
cd "$(dirname "$0")/.."

declare -A about=(
  [clang]="clang 14 compiles everything, without precompiled headers; warnings are errors"
  [bench]="every benchmark builds and runs once"
  [slurm]="\`duet slurm\` against Slurm's daemons on this machine: \`tests/slurm_test.py\`"
  [package]="the Debian package installs and renders in a new Debian 12: \`tests/package_test.sh\`"
  [library]="programs with the installed C++ library, by two compilers: \`tests/library_test.sh\`"
  [python]="the Python package: \`scripts/python.sh\`"
  [wheel]="the Python wheel installs and renders in a new Debian 12: \`tests/package_test.sh\`"
  [python_asan]="the same tests under the address and undefined-behaviour sanitizers: \`scripts/python.sh asan\`"
  [fuzz]="every fuzzer, ${DUET_FUZZ_SECONDS:-120} seconds"
  [tsan]="unit tests under the thread sanitizer"
  [statistics]="statistics under the address and undefined-behaviour sanitizers"
  [slow]="tests labelled slow, but those of other stages"
  [agreement]="every pair of unbiased methods at every depth"
  [stability]="the whole catalogue of \`duet stability\`"
  [mutations]="every bug of \`tests/mutations.py\` is noticed"
)
# Cheap ones first.
stages=(clang bench slurm package library python wheel python_asan fuzz tsan statistics slow agreement stability mutations)
logs=build-nightly
table=docs/nightly.md

# How many test cases ctest has just run in a build directory.
summary() {
  awk '/^\[doctest\] test cases:/ { cases += $4; passed += $6 }
       END { print passed " of " cases " test cases passed" }' "$1/Testing/Temporary/LastTest.log"
}

# Each stage is run by a shell of its own, which ends at the first error. Its last line stands in the table.

run_clang() {
  duet_install clang-14 libclang-rt-14-dev
  scripts/build.sh clang
  echo "no warning"
}

run_bench() {
  cmake --preset release -DDUET_BUILD_BENCH=ON
  scripts/build.sh release benchmarks
  build/rays scenes/cornell-box/scene.xml 64x64 1 1
  build/paths scenes/cornell-box/scene.xml 64x64 4 1
  build/duet_bench 1000
  build/grid_bench 10000
  build/calibrate_compare scenes/cornell-box/scene.xml reference/cornell-box path sobol 1 2 4
  build/calibrate_batches 10
  build/splats
  build/light_tree 0.1
  build/film scenes/thesis-empty/scene.xml 8 4
  build/scaling scenes/thesis-empty/scene.xml 512x512 64 64 path bdpt vcm
  echo "10 of 10 ran"
}

run_slurm() {
  scripts/build.sh release duet
  # Not by ctest: where it is skipped, it is not tested.
  tests/slurm_test.py build/duet
}

run_package() {
  scripts/package.sh
  tests/package_test.sh build/duet_*.deb "$PWD/$logs/debian"
}

run_library() {
  scripts/build.sh release duet
  tests/library_test.sh build/duet
}

run_python() {
  scripts/build.sh release duet duet_fake_oidn
  scripts/python.sh 2>&1 | tee "$logs/python.txt"
  grep '^Ran ' "$logs/python.txt"
}

run_wheel() {
  scripts/python.sh wheel
  tests/package_test.sh build-python/duet_renderer-*.whl "$PWD/$logs/debian"
}

run_python_asan() {
  scripts/python.sh asan 2>&1 | tee "$logs/python_asan.txt"
  grep -o 'Ran [0-9]* tests.*' "$logs/python_asan.txt"
}

run_fuzz() {
  duet_install clang-14 libclang-rt-14-dev
  scripts/build.sh fuzz fuzzers
  local finds="$PWD/$logs/finds" failed=() count=0 program format seeds options
  mkdir -p "$finds"
  for program in build-fuzz/fuzz_*; do
    [ -x "$program" ] || continue
    format=${program#build-fuzz/fuzz_}
    options=(-max_total_time="${DUET_FUZZ_SECONDS:-120}" -rss_limit_mb=1024 -timeout=20
      -artifact_prefix="$finds/$format-" -print_final_stats=1)
    [ ! -f "tests/fuzz/$format.dict" ] || options+=(-dict="tests/fuzz/$format.dict")
    mkdir -p "$logs/corpus/$format"
    seeds=(); [ ! -d "tests/fuzz/seeds/$format" ] || seeds=("tests/fuzz/seeds/$format")
    echo "== fuzz_$format"
    "$program" "${options[@]}" "$logs/corpus/$format" "${seeds[@]}" || failed+=("$format")
    count=$((count + 1))
  done
  echo "$count fuzzers, finds by: ${failed[*]:-none}"
  [ "${#failed[@]}" -eq 0 ] && [ "$count" -gt 0 ]
}

run_tsan() {
  scripts/build.sh tsan duet_tests
  # Embree's library is not compiled with the sanitizer: what it does by itself is not looked at.
  export TSAN_OPTIONS="die_after_fork=0 ignore_noninstrumented_modules=1"
  # Ten times slower than without the sanitizer, and beyond ctest's own limit of 25 minutes.
  ctest --test-dir build-tsan --output-on-failure --timeout 7200 -j "$(nproc)" -L unit
  summary build-tsan
}

run_statistics() {
  scripts/build.sh asan duet_tests
  ctest --test-dir build-asan --output-on-failure -R '^statistics'
  summary build-asan
}

run_slow() {
  scripts/build.sh release
  ctest --test-dir build --output-on-failure --no-tests=ignore -L slow -E '^(agreement|stability|slurm)$'
  echo "nothing failed"
}

run_agreement() {
  scripts/build.sh release
  ctest --test-dir build --output-on-failure -R '^agreement$'
  summary build
}

run_stability() {
  scripts/build.sh release
  # What docs/stability.md has to be is kept beside the log.
  build/duet stability --markdown "$logs/stability.md"
  echo "every verdict as expected"
}

run_mutations() {
  tests/mutations.py --work "$PWD/$logs/mutations"
  echo "$(tests/mutations.py --list | wc -l) bugs caught"
}

# Prints a row of the table: stage, result, minutes, date, commit.
row() {
  echo "| \`$1\` | ${about[$1]} | $2 | $3 | $4 | $5 |"
}

# Writes the table; stages that were not run keep the row of their last run.
write_table() {
  local old stage
  old=$(cat "$table" 2>/dev/null || true)
  {
    cat <<'END'
# Nightly

What takes too long for every commit is run by `scripts/nightly.sh`, which writes this table. To repeat a stage, run
`scripts/nightly.sh STAGE`; its log is then `build-nightly/STAGE.log`.

| stage | what | result | minutes | date | commit |
|---|---|---|---|---|---|
END
    for stage in "${stages[@]}"; do
      if [ -n "${rows[$stage]:-}" ]; then
        echo "${rows[$stage]}"
      else
        grep -F "| \`$stage\` |" <<<"$old" || row "$stage" "not run yet" "" "" ""
      fi
    done
  } >"$logs/table.md"
  mv "$logs/table.md" "$table"
}

if [ "${1:-}" = --list ]; then
  for stage in "${stages[@]}"; do echo "$stage: ${about[$stage]}"; done
  exit
fi
if [ "${1:-}" = --one ]; then
  . scripts/deps.sh
  "run_$2"
  exit
fi

[ $# -gt 0 ] || set -- "${stages[@]}"
for stage in "$@"; do
  if [ -z "${about[$stage]:-}" ]; then
    echo "nightly.sh: there is no stage \"$stage\"; there are ${stages[*]}" >&2
    exit 2
  fi
done
mkdir -p "$logs"
declare -A rows=()
failures=0
commit=$(git rev-parse --short HEAD)
git diff --quiet HEAD -- . ":!$table" || commit+=", changed"
for stage in "$@"; do
  echo "$stage: ${about[$stage]}"
  start=$SECONDS
  if scripts/nightly.sh --one "$stage" >"$logs/$stage.log" 2>&1; then
    result="passed: $(tail -n 1 "$logs/$stage.log")"
  else
    result="**failed**: $(tail -n 1 "$logs/$stage.log")"
    failures=$((failures + 1))
    echo "  its log is $logs/$stage.log"
  fi
  result=${result//|/\\|}
  minutes=$(awk -v s=$((SECONDS - start)) 'BEGIN { printf "%.1f", s / 60 }')
  echo "  $result ($minutes min; repeat it with scripts/nightly.sh $stage)"
  rows[$stage]=$(row "$stage" "$result" "$minutes" "$(date -u +%Y-%m-%d)" "$commit")
  write_table  # now, so that what follows can be interrupted
done
[ "$failures" -eq 0 ]
