# shellcheck shell=bash
# Sourced by tests that take a program out of a text: compiles program.c to a.out by the command of
# the README, in the current folder.

link_program() {
  local flags libraries embree
  # The flags of this build, so that a library built with a sanitizer links as well.
  read -r -a flags <<<"$(sed -n 's/^CMAKE_C_FLAGS:STRING=//p' "$HRAD_BINARY_DIR/CMakeCache.txt")"
  read -r -a libraries <<<"$(pkg-config --libs hwloc zlib)"
  for embree in '' -lembree3 -lembree4; do
    cc -std=c99 -pedantic -Wall -Wextra -Werror "${flags[@]}" -I"$HRAD_SOURCE_DIR/include" program.c \
      "$HRAD_BINARY_DIR/lib/libhrad.a" "${libraries[@]}" -lstdc++ -lm -pthread $embree 2>errors &&
      return
  done
  cat errors >&2
  return 1
}
