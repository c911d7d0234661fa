#!/usr/bin/env bash
# An error whose status nobody asks for stops a Fortran program: the message is on standard error,
# the exit status tells, and the program doesn't go on.
set -euo pipefail

program=$HRAD_BINARY_DIR/tests/fortran_stop_without_status
if [[ ! -x $program ]]; then
  echo "The Fortran module is not in this build."
  exit 77
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# stops WHO MESSAGE: the program ends with an error and says this first.
stops() {
  if "$program" "$1" >said 2>errors; then
    echo "$1: no error"
    exit 1
  fi
  [[ ! -s said ]]
  head -n 1 errors | grep -q "$2" || { cat errors; exit 1; }
}

stops library '^hrad: HRAD_ERROR_ARGUMENT: .*no such scene'
stops binding '^hrad: HRAD_ERROR_ARGUMENT: hrad_add_patches: xyz has the shape (2, 3), it needs (3, \*)$'
