#!/usr/bin/env bash
# The finite-element example in tests/consumers/fortran: every step's fluxes balance as the library
# itself says, and the room answers to its heater.
set -euo pipefail
# shellcheck source=tests/consumers/fortran.sh
source "$HRAD_SOURCE_DIR/tests/consumers/fortran.sh"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

link_fortran heated_room "$HRAD_SOURCE_DIR/tests/consumers/fortran/room_mesh.f90" \
  "$HRAD_SOURCE_DIR/tests/consumers/fortran/heated_room.f90"
./heated_room | tee said

# Columns: step, heater K, net flux of heater, floor, ceiling, 4 walls, imbalance, the library's own
# imbalance, floor K.
awk '
  function fault(what) { print "step " $1 ": " what; faults++ }
  function size(x) { return x < 0 ? -x : x }
  NF != 12 { fault(NF " columns") }
  $3 <= 0 { fault("the heater takes power in") }
  size($10) > 0.01 * $3 { fault("the fluxes miss more than 1 % of balance") }
  size($10 - $11) > 1e-5 * $3 { fault("the fluxes balance otherwise than the library says") }
  { for (i = 4; i <= 9; ++i) if ($i >= 0) fault("face " i - 2 " gives power off") }
  NR > 1 && $3 <= heater { fault("a hotter heater gives no more power off") }
  NR > 1 && $12 <= floor { fault("the floor gets no warmer") }
  { for (i = 4; i <= 9; ++i) { if (NR > 1 && $i >= before[i]) fault("face " i - 2 " takes no more in")
                               before[i] = $i } }
  { heater = $3; floor = $12 }
  END { if (NR != 6) { print NR " steps, not 6"; faults++ } exit faults > 0 }
' said
