// A uniform 3D grid (paper, Section 3.1). Floor 6 (partition).
#include <algorithm>
#include <array>

#include "partition/partition.h"

namespace hrad {
namespace {

using Cells = std::array<int32_t, 3>;

// Of all grids of so many cells the one whose cells have the least surface: what is cut is what
// talks. Of equal ones the first, with fewer cells along x, then y.
Cells cells_along_axes(Vec3 extent, int32_t ranks) {
  Cells best{1, 1, ranks};
  double least = -1;
  for (int32_t x = 1; x <= ranks; ++x) {
    if (ranks % x != 0) continue;
    for (int32_t y = 1; y <= ranks / x; ++y) {
      if (ranks / x % y != 0) continue;
      const int32_t z = ranks / x / y;
      const Vec3 side{extent.x / x, extent.y / y, extent.z / z};
      const double surface = side.x * side.y + side.y * side.z + side.z * side.x;
      if (least >= 0 && surface >= least) continue;
      least = surface;
      best = {x, y, z};
    }
  }
  return best;
}

int32_t cell_of(double place, double low, double extent, int32_t cells) {
  if (!(extent > 0)) return 0;
  const double cell = (place - low) / extent * cells;
  return std::min(cells - 1, std::max(0, static_cast<int32_t>(cell)));
}

}  // namespace

std::vector<int32_t> divide_by_grid(const std::vector<PartitionItem>& items, int32_t ranks) {
  Box box;
  for (const PartitionItem& item : items) box.grow(item.place);
  const Vec3 extent = items.empty() ? Vec3{} : box.extent();
  const Cells cells = cells_along_axes(extent, ranks);
  std::vector<int32_t> result;
  for (const PartitionItem& item : items) {
    const int32_t x = cell_of(item.place.x, box.low.x, extent.x, cells[0]);
    const int32_t y = cell_of(item.place.y, box.low.y, extent.y, cells[1]);
    const int32_t z = cell_of(item.place.z, box.low.z, extent.z, cells[2]);
    result.push_back((z * cells[1] + y) * cells[0] + x);
  }
  return result;
}

}  // namespace hrad
