#!/usr/bin/env bash
# The same bits everywhere: builds, then solves four scenes by every method of linking on 1 to 8 ranks of
# 1 to 4 threads with both partitions, and compares hashes and exported files byte by byte. Ranks are
# threads of one process, so that it needs no MPI. Some ten minutes on two cores.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash tests/configure.sh release build-tests -DHRAD_TESTS=ON -DHRAD_WERROR=ON
cmake --build build-tests --parallel "$(nproc)" --target test_solver_matrix
build-tests/tests/test_solver_matrix all
