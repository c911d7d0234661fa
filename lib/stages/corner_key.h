// Names of the corners of elements. Floor 7 (stages).
#pragma once

#include <cstdint>

#include "hierarchy/lattice.h"

namespace hrad {

// A surface and a point of its lattice: no point is shared by two surfaces.
inline uint64_t key_of_corner(int32_t surface, LatticePoint p) {
  return static_cast<uint64_t>(surface) << 32 | static_cast<uint64_t>(p.i) << 16 |
         static_cast<uint64_t>(p.j);
}
inline int32_t surface_of_corner(uint64_t key) { return static_cast<int32_t>(key >> 32); }
inline LatticePoint point_of_corner(uint64_t key) {
  return {static_cast<int32_t>(key >> 16 & 0xffff), static_cast<int32_t>(key & 0xffff)};
}

}  // namespace hrad
