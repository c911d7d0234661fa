#!/usr/bin/env bash
# Installs the Debian packages that are missing, by apt; does nothing, and needs no network, when
# all are there.
#   bash tests/setup.sh         what building the library and the tool needs
#   bash tests/setup.sh tests   and what the tests need besides
#   bash tests/setup.sh full    and what the linters, the packages and the largest tests need
set -euo pipefail

packages=(g++ cmake ninja-build pkg-config libhwloc-dev libcli11-dev libpng-dev
  zlib1g-dev)
# Several processes; everything else works without.
optional=(libopenmpi-dev openmpi-bin)
case "${1:-build}" in
  build) ;;
  tests | full)
    packages+=(libcmocka-dev make python3)
    # The second ray engine, against which the built-in one is checked; not on every architecture.
    optional+=(libembree-dev)
    # The module for Fortran programs.
    optional+=(gfortran)
    # The module for Python programs, also on several processes.
    optional+=(python3-numpy python3-mpi4py)
    # Its libFuzzer looks for input that breaks the readers and the C interface.
    optional+=(clang)
    # They check the manual pages and the scripts.
    optional+=(mandoc shellcheck)
    if [[ $1 == full ]]; then
      # The other linters.
      optional+=(clang-tidy cppcheck lintian)
      # VTK reads exported files; Matplotlib draws the example in Python.
      optional+=(python3-vtk9 python3-matplotlib)
      # What packages depend on, and a bare system to try them in.
      optional+=(dpkg-dev debootstrap)
    fi
    ;;
  *)
    echo "usage: bash tests/setup.sh [build|tests|full]" >&2
    exit 2
    ;;
esac

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "This is no Debian system: make sure that there are a C++17 compiler, cmake, ninja," \
    "pkg-config, hwloc, zlib, CLI11 and, for pictures, libpng, for several processes MPI (for the tests also cmocka and python3)." >&2
  exit 0
fi

is_installed() {
  [[ $(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null) == installed ]]
}

missing=() missing_optional=()
for package in "${packages[@]}"; do is_installed "$package" || missing+=("$package"); done
for package in "${optional[@]}"; do is_installed "$package" || missing_optional+=("$package"); done
if [[ ${#missing[@]} == 0 && ${#missing_optional[@]} == 0 ]]; then exit 0; fi

as_root=()
if [[ $(id -u) != 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "As root, install: apt-get install ${missing[*]} ${missing_optional[*]}" >&2
    [[ ${#missing[@]} == 0 ]] && exit 0
    exit 1
  fi
  as_root=(sudo)
fi

apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get --quiet --quiet --option DPkg::Lock::Timeout=300 "$@"
}

echo "Installing ${missing[*]} ${missing_optional[*]}" >&2
apt update || echo "The package lists could not be renewed; going on with those that are here." >&2
if [[ ${#missing[@]} != 0 ]]; then
  apt install --yes --no-install-recommends "${missing[@]}" >/dev/null
fi
for package in "${missing_optional[@]}"; do
  apt install --yes --no-install-recommends "$package" >/dev/null ||
    echo "Going on without the optional $package." >&2
done
