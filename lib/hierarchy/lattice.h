// The lattice that the finest subdivision draws on a patch, on which elements of all levels name
// their corners exactly. Floor 5 (hierarchy).
#pragma once

#include <cstdint>

#include "hierarchy/forest.h"

namespace hrad {

struct LatticePoint {
  int32_t i, j;
};

constexpr int32_t lattice_size = 1 << max_level;

// The corners of an element in the order of Forest::triangle.
inline void lattice_corners(const Node& place, LatticePoint corner[3]) {
  const int32_t step = 1 << (max_level - place.level);
  const int32_t i = place.i * step, j = place.j * step;
  if (!place.inverted) {
    corner[0] = {i, j};
    corner[1] = {i + step, j};
    corner[2] = {i, j + step};
  } else {
    corner[0] = {i + step, j + step};
    corner[1] = {i, j + step};
    corner[2] = {i + step, j};
  }
}

}  // namespace hrad
