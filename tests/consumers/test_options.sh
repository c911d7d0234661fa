#!/usr/bin/env bash
# What CMake does not find it looks for again: a build folder made without a Fortran compiler or MPI has
# them as soon as they are there. A user's OFF stays, until AUTO.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# configure OPTION...: as it says; then is FORTRAN MPI: what the folder has now, ON or nothing.
configure() {
  said="cmake $*"
  cmake -S "$HRAD_SOURCE_DIR" -B build -DHRAD_TESTS=OFF -DHRAD_EMBREE=OFF "$@" >configured 2>&1 ||
    { cat configured && exit 1; }
}
option() { sed -n "s/^HRAD_$1:BOOL=//p" "$2/CMakeCache.txt"; }
is() {
  local found
  found="$(option FORTRAN build),$(option MPI build)"
  [[ $found == "$1" ]] || { echo "after '$said' Fortran and MPI are $found, not $1" >&2 && exit 1; }
}

# Whether there are any is what the build of these tests says that has them.
fortran=$(option FORTRAN "$HRAD_BINARY_DIR") mpi=$(option MPI "$HRAD_BINARY_DIR")
fortran=${fortran:-OFF} mpi=${mpi:-OFF}
if [[ $fortran != ON && $mpi != ON ]]; then
  echo "Neither Fortran nor MPI in this build."
  exit 77
fi
without=(-DHRAD_FORTRAN=OFF)
if [[ $fortran == ON ]]; then without=(); fi
if [[ $mpi != ON ]]; then without+=(-DHRAD_MPI=OFF); fi

FC=$folder/none configure "${without[@]}" -DCMAKE_DISABLE_FIND_PACKAGE_MPI=ON
is "${fortran/ON/},${mpi/ON/}"
FC=$folder/none configure
is "${fortran/ON/},${mpi/ON/}"
configure -DCMAKE_DISABLE_FIND_PACKAGE_MPI=OFF
is "$fortran,$mpi"
[[ $mpi != ON || -e build/pkgconfig/hrad-mpi.pc ]]
[[ $fortran != ON || -e build/pkgconfig/hrad-fortran.pc ]]

configure -DHRAD_FORTRAN=OFF -DHRAD_MPI=OFF
is OFF,OFF
configure
is OFF,OFF
if [[ $fortran == ON && $mpi == ON ]]; then
  configure -DHRAD_FORTRAN=AUTO -DHRAD_MPI=AUTO
  is ON,ON
fi
