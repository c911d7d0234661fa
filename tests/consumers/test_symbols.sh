#!/usr/bin/env bash
# What the built libraries call their own for all who link them: hrad_*, namespace hrad and the Fortran
# modules hrad* in archives; hrad_* alone, with a version, in shared libraries, which are named by what
# programs can rely on.
set -euo pipefail
if grep -Eq '^CMAKE_(C|CXX)_FLAGS:.*(-fsanitize|--coverage)' "$HRAD_BINARY_DIR/CMakeCache.txt"; then
  echo "Sanitizers and coverage bring names of their own."
  exit 77
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# Weak names are of templates that every program may have.
found=0
for archive in "$HRAD_BINARY_DIR"/lib/libhrad*.a "$HRAD_BINARY_DIR"/bindings/fortran/libhrad*.a; do
  [[ -e $archive ]] || continue
  found=$((found + 1))
  nm --defined-only --extern-only --format=posix "$archive" 2>/dev/null |
    sed -n 's/^\([^ ]*\) [^WVwvu] .*/\1/p' >names
  [[ -s names ]] || { echo "$archive gives nothing" >&2 && exit 1; }
  if grep -Ev '^hrad_[a-z_]+$|^_Z(T[VISTC]|GV|GR|L)*(N[KVRO]*)?4hrad|^__hrad[a-z_]*_MOD_' names; then
    echo "$archive has names that may be another's" >&2
    exit 1
  fi
done
[[ $found != 0 ]]

version=$(sed -n 's/^CMAKE_PROJECT_VERSION:[A-Z]*=\([0-9]*\.[0-9]*\)\..*/\1/p' "$HRAD_BINARY_DIR/CMakeCache.txt")
# A static build has them too, for Python's tests.
found=0
for library in "$HRAD_BINARY_DIR"/lib/libhrad*.so "$HRAD_BINARY_DIR"/tests/python/libhrad*.so; do
  [[ -e $library ]] || continue
  found=$((found + 1))
  name=$(basename "$library").$version
  objdump -p "$library" | grep -E "SONAME +$name\$" >names || { echo "$library is not $name" >&2 && exit 1; }
  nm --dynamic --defined-only --extern-only --format=posix "$library" >names
  grep -q '^hrad_create' names
  if grep -Ev "^hrad_[a-z_]+@@HRAD_$version T |^HRAD_$version A" names; then
    echo "$library exports more than hrad_*" >&2
    exit 1
  fi
done
[[ $found != 0 || ! -d $HRAD_BINARY_DIR/tests/python ]]
