// Opening the cubes of a LightGrid for points that only the owner of their surface knows of.
// Floor 7 (stages).
#pragma once

#include <vector>

#include "links/light_grid.h"
#include "stages/state.h"

namespace hrad {

struct KeyedPoint {
  int32_t surface;
  uint64_t key;  // with the surface the point's name
  OrientedPoint point;
};

// Collective; own: on this process's surfaces. Whoever owns them, the cubes are opened by the same
// points in the same order. Returns the number of this process's rays.
int64_t open_cubes(LightGrid& grid, const std::vector<KeyedPoint>& own, const StageTools& tools);

}  // namespace hrad
