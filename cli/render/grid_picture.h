// A grid of sensors as a false-colour picture with a legend. CLI: public headers only.
#pragma once

#include <vector>

#include "render/image.h"
#include "sensors.h"

namespace hrad::cli {

// Failure (usage) for a grid that no picture of reasonable size shows: asked before it is measured.
void check_grid_for_picture(const SensorGrid& grid);

// values: irradiance summed over the bands, cell by cell, the first axis running fastest. That axis
// points to the right, the second one up; lengths keep their proportions.
Image make_grid_picture(const SensorGrid& grid, const std::vector<double>& values, size_t bands);

}  // namespace hrad::cli
