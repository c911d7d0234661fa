#!/usr/bin/env bash
# Checkpoints lose nothing: builds, then kills solves at random moments, N times (300) altogether, on 1
# to 4 ranks of 1 to 4 threads, and goes on with them on others; and damages files in thousands of ways
# under limits of time and memory. HRAD_SEED=S draws the same moments again. Some half an hour on two cores.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash tests/configure.sh release build-tests -DHRAD_TESTS=ON -DHRAD_WERROR=ON
cmake --build build-tests --parallel "$(nproc)" --target hrad_cli
HRAD_KILLS=${1:-300} HRAD_LONG=1 ctest --test-dir build-tests -R '^cli_(kills|damage)$' --verbose --timeout 20000
