// How many rays the row of each cell has. Floor 7 (stages).
#pragma once

#include <vector>

#include "stages/bright_spots.h"
#include "stages/rows.h"

namespace hrad {

// Pilot rows tell where light varies, not how much there is: they have so many times fewer rays.
constexpr int pilot_share = 4;

// Before it is known what the cells see.
std::vector<int> rays_by_area(const State& state, const StageTools& tools,
                              const RowSettings& settings, const std::vector<NodeId>& cells);

// For state.cells, by what their pilot rows see. Others' cells have no rows here, and get none.
std::vector<int> rays_by_variance(const State& state, const StageTools& tools,
                                  const RowSettings& settings, const Brightness& light,
                                  const BrightSpots& spots);

}  // namespace hrad
