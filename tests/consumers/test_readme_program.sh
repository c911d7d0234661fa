#!/usr/bin/env bash
# The program of the README, compiled from its text by the README's command and run: it says how
# much power was emitted and leaves its table.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

sed -n '/^```c$/,/^```$/p' "$HRAD_SOURCE_DIR/README.md" | sed '1d;$d' >program.c
# The flags of this build, so that a library built with a sanitizer links as well.
read -r -a flags <<<"$(sed -n 's/^CMAKE_C_FLAGS:STRING=//p' "$HRAD_BINARY_DIR/CMakeCache.txt")"
read -r -a hwloc <<<"$(pkg-config --libs hwloc zlib)"

linked=false
for embree in '' -lembree3 -lembree4; do
  if cc -std=c99 -Wall -Wextra -Werror "${flags[@]}" -I"$HRAD_SOURCE_DIR/include" program.c \
    "$HRAD_BINARY_DIR/lib/libhrad.a" "${hwloc[@]}" -lstdc++ -lm -pthread $embree 2>errors; then
    linked=true
    break
  fi
done
if ! $linked; then
  cat errors
  exit 1
fi

./a.out | tee said
grep -Eq '^emitted [0-9.e+]+ W, absorbed [0-9.e+]+ W$' said
head -n 1 cornell.csv | grep -q '^patch,face,side,x0,.*,area,b0,b1,b2$'
[[ $(wc -l <cornell.csv) -gt 30 ]]
