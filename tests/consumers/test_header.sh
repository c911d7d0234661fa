#!/usr/bin/env bash
# hrad.h in the hands of others: it compiles alone and twice over in every language it promises, by
# every compiler that is here, with all warnings as errors, and every function that it declares is in
# the library.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat >twice.c <<'END'
#include <hrad/hrad.h>
#include <hrad/hrad.h>
hrad_status use(hrad_solver **solver);
hrad_status use(hrad_solver **solver) { return hrad_create(solver); }
END
cp twice.c twice.cpp
warnings=(-Wall -Wextra -pedantic -Werror -Wshadow -Wundef)
for compiler in cc gcc clang; do
  command -v $compiler >/dev/null || continue
  for standard in c99 c11 c17; do
    for shared in '' -DHRAD_SHARED; do
      "$compiler" -std=$standard "${warnings[@]}" -Wstrict-prototypes $shared \
        -I"$HRAD_SOURCE_DIR/include" -c twice.c
    done
  done
done
for compiler in c++ g++ clang++; do
  command -v $compiler >/dev/null || continue
  for standard in c++11 c++17 c++20; do
    "$compiler" -std=$standard "${warnings[@]}" -I"$HRAD_SOURCE_DIR/include" -c twice.cpp
  done
done

sed -n 's/^HRAD_API.*[ *]\(hrad_[a-z_]*\)(.*/\1/p' "$HRAD_SOURCE_DIR/include/hrad/hrad.h" |
  sort >declared
nm --defined-only "$HRAD_BINARY_DIR/lib/libhrad.a" 2>/dev/null |
  sed -n 's/^[0-9a-f]* T \(hrad_[a-z_]*\)$/\1/p' | sort >defined
[[ $(wc -l <declared) -ge 40 ]]
# The seam to the library hrad_mpi is nobody else's.
grep -o '\bhrad_create_over(' "$HRAD_SOURCE_DIR/lib/api/create_over.h" | tr -d '(' >seam
sort -o declared declared seam
# The same names: nothing is missing, and nothing is exported that the header doesn't tell of.
diff declared defined
