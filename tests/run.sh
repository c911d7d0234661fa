#!/usr/bin/env bash
# Every test of a fresh clone: installs what is missing (Debian, as root or with sudo), builds with
# warnings as errors, runs the tests.
#   bash tests/run.sh          every test, some minutes on two cores
#   bash tests/run.sh --full   before that the same tests under the address, undefined behaviour and
#                              thread sanitizers, and all benchmarks
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

full=false
case "${1:-}" in
  '') ;;
  --full) full=true ;;
  *)
    echo "usage: bash tests/run.sh [--full]" >&2
    exit 2
    ;;
esac

# build PRESET FOLDER: configures and builds the library, the tool, the tests and the benchmarks.
build() {
  local generator=(-G Ninja)
  if [[ -f $2/CMakeCache.txt ]]; then generator=(); fi  # a configured folder keeps its own
  cmake --preset "$1" -B "$2" "${generator[@]}" -DHRAD_TESTS=ON -DHRAD_WERROR=ON
  cmake --build "$2" --parallel "$(nproc)"
}

# run_tests FOLDER SECONDS: a test that takes longer than that has lost its way.
run_tests() {
  ctest --test-dir "$1" --output-on-failure --no-tests=error -j2 --timeout "$2"
}

bash tests/setup.sh tests

if $full; then
  for sanitizer in asan tsan; do
    build "$sanitizer" "build-$sanitizer"
    run_tests "build-$sanitizer" 3600
  done
fi

build release build-tests
if $full; then
  # What they print is explained in tests/bench/README.md.
  build-tests/tests/bench_visibility classroom building boxes soup
  mkdir -p out/references
  build-tests/tests/bench_paper --reference-dir out/references --reference-seconds 130 \
    --case accuracy=0.05 --case accuracy=0.02 building classroom
fi
run_tests build-tests 600
