#!/usr/bin/env bash
# Line coverage of lib/ by the tests: builds with the preset coverage (gcc with gcov), runs the tests,
# prints the share of lines that were run, per file and in all.
#   bash tests/coverage.sh            the lines of each file
#   bash tests/coverage.sh --lines    and the numbers of the lines that no test reaches
# HRAD_COVERAGE_DIR names another build folder than build-coverage, HRAD_COVERAGE_TESTS a regular
# expression for the names of the tests to run (default: all).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=${HRAD_COVERAGE_DIR:-build-coverage}

case "${1:-}" in
  '' | --lines) ;;
  *)
    echo "usage: bash tests/coverage.sh [--lines]" >&2
    exit 2
    ;;
esac

bash tests/configure.sh coverage "$folder" -DHRAD_TESTS=ON >/dev/null
cmake --build "$folder" --parallel "$(nproc)" >/dev/null
find "$folder" -name '*.gcda' -delete
# A test that fails still counts what it ran; its name is printed.
ctest --test-dir "$folder" -j2 --timeout 3600 -R "${HRAD_COVERAGE_TESTS:-.}" |
  grep -E 'Failed|Timeout|tests passed' || true
python3 tests/coverage.py "$folder" "$@"
