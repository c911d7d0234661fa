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

inline LatticePoint middle(LatticePoint a, LatticePoint b) {
  return {(a.i + b.i) / 2, (a.j + b.j) / 2};
}

// Points half way from the corners to the middle, in the order of these.
inline void half_way_points(const Node& place, LatticePoint point[3]) {
  LatticePoint corner[3];
  lattice_corners(place, corner);
  const int32_t i = corner[0].i + corner[1].i + corner[2].i;
  const int32_t j = corner[0].j + corner[1].j + corner[2].j;
  for (int c = 0; c < 3; ++c) point[c] = {(3 * corner[c].i + i) / 6, (3 * corner[c].j + j) / 6};
}

}  // namespace hrad
