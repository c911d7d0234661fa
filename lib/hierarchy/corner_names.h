// Names for the corners of elements that neighbouring surfaces in one plane agree on, and facets of
// one curved surface: exact, by lattice coordinates and shared edges, never by comparing rounded
// positions. Floor 5 (hierarchy).
#pragma once

#include <cstdint>
#include <vector>

#include "hierarchy/lattice.h"

namespace hrad {

class CornerNames {
 public:
  // Surfaces no larger than facet_area that meet at a shallow edge are joined as if they lay in one
  // plane.
  explicit CornerNames(const Forest& forest, double facet_area = 0);

  // Surfaces joined in one plane, by their first one.
  int32_t plane(int32_t surface) const { return plane_[static_cast<size_t>(surface)]; }
  // Of a point of a surface: within its plane no other point has this name.
  uint64_t name(int32_t surface, LatticePoint point) const;

 private:
  std::vector<int32_t> plane_;   // per surface
  std::vector<int32_t> vertex_;  // per surface and corner: welded vertex
  std::vector<int32_t> edge_;    // per surface and corner: the edge from there to the next one
};

}  // namespace hrad
