#!/usr/bin/env bash
# The install components, of which packages are made: together they are the whole installation, no file
# is in two of them, and each has what its name says.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

complain() {
  echo "$@" >&2
  exit 1
}

# install_to FOLDER OPTIONS...: leaves the files and links there, one a line, in FOLDER.files.
install_to() {
  cmake --install "$HRAD_BINARY_DIR" --prefix "$folder/$1" "${@:2}" >/dev/null
  (cd "$1" && find . ! -type d | sort) >"$1.files"
}

install_to whole
mapfile -t components < <(find "$HRAD_BINARY_DIR" -name cmake_install.cmake -exec \
  sed -n 's/.*CMAKE_INSTALL_COMPONENT STREQUAL "\([^"]*\)".*/\1/p' {} + | sort -u)
for component in "${components[@]}"; do
  case $component in
    runtime | library | library_mpi | development | development_mpi | fortran | python | documentation) ;;
    *) complain "an install() is in the component $component" ;;
  esac
  install_to "$component" --component "$component"
done
for component in "${components[@]}"; do cat "$component.files"; done | sort | diff whole.files - ||
  complain "the components (>) are not the whole (<)"

# has COMPONENT NAME...: a path in it ends so.
has() {
  local name
  for name in "${@:2}"; do
    grep -q "/$name\$" "$1.files" || complain "the component $1 lacks $name"
  done
}

library=libhrad.a
if grep -q '^BUILD_SHARED_LIBS:BOOL=ON' "$HRAD_BINARY_DIR/CMakeCache.txt"; then
  library=libhrad.so
  has library 'libhrad\.so\.[0-9.]*'
fi
has runtime bin/hrad man1/hrad.1 man5/hrad-scene.5 man7/hrad-params.7 bash-completion/completions/hrad
has development include/hrad/hrad.h "$library" pkgconfig/hrad.pc hradConfig.cmake hradTargets.cmake \
  man3/libhrad.3 man3/hrad_solve.3
# Every example, and nothing else: tests and what they share stay in the sources.
(cd "$HRAD_SOURCE_DIR/tests/consumers" && find . -mindepth 2 -name '__pycache__' -prune -o -mindepth 2 -type f \
  -regex '.*/\(Makefile\|CMakeLists\.txt\|[a-z_]*\.\(c\|cpp\|f90\|sh\|py\)\)' -print && echo ./work_plane.c) |
  sort >examples
[[ $(wc -l <examples) -ge 8 ]]
sed -n 's|^.*/doc/hrad/examples|.|p' documentation.files | diff examples - ||
  complain "the documentation has other examples (>) than the sources (<)"
has documentation README.md LICENSE examples/batch/job.sh examples/python/work_plane.py
for folder in whole documentation; do
  if (cd $folder && find . -type d -empty) | grep .; then complain "these folders are empty"; fi
done
if grep -q '^HRAD_MPI:BOOL=ON' "$HRAD_BINARY_DIR/CMakeCache.txt"; then
  has development_mpi include/hrad/hrad_mpi.h 'libhrad_mpi\.[aso]*' pkgconfig/hrad-mpi.pc hradMpiTargets.cmake
fi
if grep -q '^HRAD_FORTRAN:BOOL=ON' "$HRAD_BINARY_DIR/CMakeCache.txt"; then
  has fortran libhrad_fortran.a hrad.mod hrad.f90 pkgconfig/hrad-fortran.pc hradFortranTargets.cmake \
    man3/hrad-fortran.3
fi

# The copyright file of the packages has the terms of LICENSE, word for word.
sed -n '/^Redistribution/,$p' "$HRAD_SOURCE_DIR/LICENSE" >terms
sed -n '/^License: BSD-3-Clause$/,/^$/{s/^ \.\{0,1\}//;/^Redistribution/,$p}' \
  "$HRAD_SOURCE_DIR/pkgconfig/debian/copyright" | sed '$d' | diff terms - ||
  complain "pkgconfig/debian/copyright differs from LICENSE"
