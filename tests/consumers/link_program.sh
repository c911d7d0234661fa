# shellcheck shell=bash
# Sourced by tests that take a program out of a text: compiles program.c to a.out by the command of
# the README, in the current folder.

link_program() {
  local flags library
  # The flags of this build, so that a library built with a sanitizer links as well.
  read -r -a flags <<<"$(sed -n 's/^CMAKE_C_FLAGS:STRING=//p' "$HRAD_BINARY_DIR/CMakeCache.txt")"
  library=$(PKG_CONFIG_PATH=$HRAD_BINARY_DIR/pkgconfig pkg-config --cflags --libs --static hrad)
  read -r -a library <<<"$library"
  cc -std=c99 -pedantic -Wall -Wextra -Werror "${flags[@]}" program.c "${library[@]}"
}
