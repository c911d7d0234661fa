# shellcheck shell=bash
# For the tests of Fortran programs, to be sourced: links them by the README's command against this
# build; the test is skipped where the build has no Fortran module.

if [[ ! -f $HRAD_BINARY_DIR/bindings/fortran/libhrad_fortran.a ||
  ! -f $HRAD_BINARY_DIR/lib/libhrad.a ]]; then
  echo "The Fortran module or the static library is not in this build."
  exit 77
fi
if grep -q '^CMAKE_C_FLAGS:.*-fsanitize' "$HRAD_BINARY_DIR/CMakeCache.txt" &&
  grep -q '^CMAKE_CXX_COMPILER:.*clang' "$HRAD_BINARY_DIR/CMakeCache.txt"; then
  echo "gfortran can't link what clang's sanitizers are in."
  exit 77
fi

# link_fortran PROGRAM SOURCE...: every warning is an error.
link_fortran() {
  local program=$1 compiler flags library
  shift
  compiler=$(sed -n 's/^CMAKE_Fortran_COMPILER:[A-Z]*=//p' "$HRAD_BINARY_DIR/CMakeCache.txt")
  # The flags of this build, so that a library built with a sanitizer links as well.
  read -r -a flags <<<"$(sed -n 's/^CMAKE_C_FLAGS:STRING=//p' "$HRAD_BINARY_DIR/CMakeCache.txt")"
  library=$(PKG_CONFIG_PATH=$HRAD_BINARY_DIR/pkgconfig pkg-config --cflags --libs --static hrad-fortran)
  read -r -a library <<<"$library"
  "$compiler" -std=f2008 -O2 -Wall -Wextra -Werror "${flags[@]}" "$@" -o "$program" "${library[@]}"
}
