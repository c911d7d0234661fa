#!/usr/bin/env bash
# Every example in the hands of a stranger: builds the library from this clone, installs it into a scratch
# prefix, moves that, and builds and runs all of tests/consumers outside the tree: C by make with gcc and
# clang, C and C++ by CMake, Fortran, a project of C and Fortran, C and Fortran over several MPI processes,
# the batch job with the installed tool; then, with a shared library, a project that has the library as a
# part of itself, and Python. What the machine lacks is left out, and named at the end. Two builds: some
# ten minutes of one processor, and a minute of examples.
#   bash tests/consumers.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source=$PWD

bash tests/setup.sh tests
# shellcheck source=tests/mpi/environment.sh
source tests/mpi/environment.sh
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

left_out=()
for tool in gcc clang gfortran mpicc mpifort mpirun; do
  command -v $tool >/dev/null || left_out+=("$tool")
done

# test_of SCRIPT BUILD: a test of this tree, on a build of it; 77: not for this machine.
test_of() {
  local status=0
  echo "== $1" >&2
  (
    cd "$folder"
    HRAD_SOURCE_DIR=$source HRAD_BINARY_DIR=$2 bash "$source/tests/$1"
  ) || status=$?
  if [[ $status == 77 ]]; then left_out+=("$1"); fi
  [[ $status == 0 || $status == 77 ]]
}

# install BUILD NAME: to a prefix that is then moved, $folder/NAME.
install() {
  cmake --install "$1" --prefix "$folder/first" >/dev/null
  mv "$folder/first" "$folder/$2"
}

echo "== archives" >&2
bash tests/configure.sh release build-consumers -DHRAD_TESTS=OFF -DHRAD_WERROR=ON >/dev/null
cmake --build build-consumers --parallel "$(nproc)" >/dev/null
test_of consumers/test_installed.sh "$source/build-consumers"
test_of mpi/test_installed.sh "$source/build-consumers"
install build-consumers archives
HRAD=$folder/archives/bin/hrad HRAD_JOB=$folder/archives/share/doc/hrad/examples/batch/job.sh \
  test_of consumers/test_batch.sh "$source/build-consumers"

echo "== a project that has the library as a part of itself, shared libraries" >&2
mkdir "$folder/project"
cp tests/consumers/work_plane.c "$folder/project"
cat >"$folder/project/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.18)
project(work_plane LANGUAGES C)
set(BUILD_SHARED_LIBS ON)
set(HRAD_TESTS OFF)
add_subdirectory($source libhrad)
add_executable(work_plane work_plane.c)
target_link_libraries(work_plane PRIVATE hrad::hrad)
END
cmake -S "$folder/project" -B "$folder/project/build" -DCMAKE_BUILD_TYPE=Release >"$folder/said" ||
  { cat "$folder/said" && exit 1; }
cmake --build "$folder/project/build" --parallel "$(nproc)" >"$folder/said" || { cat "$folder/said" && exit 1; }
"$folder/project/build/work_plane"
install "$folder/project/build" shared

echo "== Python" >&2
python=
for candidate in python3 /usr/bin/python3; do  # Debian's modules belong to Debian's interpreter
  if [[ -z $python ]] && "$candidate" -c 'import numpy, matplotlib' 2>/dev/null; then python=$candidate; fi
done
if [[ -n $python ]]; then
  module=$(find "$folder/shared" -type d -path '*/python3/dist-packages')
  (
    cd "$folder"
    unset HRAD_LIBRARY
    PYTHONPATH=$module "$python" shared/share/doc/hrad/examples/python/work_plane.py plane.png 2>/dev/null
    [[ $(head -c 4 plane.png | tail -c 3) == PNG ]]
  )
else
  left_out+=("the example in Python, which needs NumPy and Matplotlib")
fi

echo "Every example was built and has run." >&2
for name in "${left_out[@]}"; do echo "Left out: $name" >&2; done
