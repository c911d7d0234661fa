// Opening the cubes of a LightGrid for points that only the owner of their surface knows of.
// Floor 7 (stages).
#pragma once

#include <functional>
#include <vector>

#include "links/light_grid.h"
#include "stages/state.h"

namespace hrad {

struct KeyedPoint {
  int32_t surface;
  uint64_t key;  // with the surface the point's name
  OrientedPoint point;
};

// Collective; own(k), on any thread: so many points on this process's surfaces. Whoever owns them,
// the cubes are opened by the same points in the same order. False: stopped.
bool open_cubes(LightGrid& grid, size_t count, const std::function<KeyedPoint(size_t)>& own,
                State& state, const StageTools& tools);
// The same by points that all processes give.
bool open_cubes(LightGrid& grid, const std::vector<OrientedPoint>& points, State& state,
                const StageTools& tools);

}  // namespace hrad
