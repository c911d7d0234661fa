#!/usr/bin/env bash
# From a fresh clone to a first result: installs what is missing (Debian, as root or with sudo),
# builds the library and the tool, solves the Classroom scene, and leaves its summary, a picture and
# the solution as .vtu and .csv in the folder out/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash tests/setup.sh build

bash tests/configure.sh release build -DHRAD_TESTS=OFF
cmake --build build --parallel "$(nproc)"

mkdir -p out
build/hrad solve classroom -o out/classroom.png -o out/classroom.vtu -o out/classroom.csv |
  tee out/classroom.txt
echo "This summary is in out/classroom.txt."
