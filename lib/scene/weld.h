// Vertices at exactly the same place count as one. Floor 3 (scene).
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec3.h"

namespace hrad {

// Per vertex a number of its position: equal for equal positions (-0 is 0), otherwise different,
// ascending with x, then y, then z.
std::vector<int32_t> weld(const std::vector<Vec3>& vertices);

}  // namespace hrad
