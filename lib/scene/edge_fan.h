// The patches around an edge, in pairs that bound what is solid between them. Floor 3 (scene).
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/vec3.h"

namespace hrad {

// A patch at an edge that leads from `low` to `high`.
struct EdgePatch {
  Vec3 apex;  // its corner off the edge
  int32_t patch;
  bool reversed;  // it runs along the edge from high to low
};

// Goes round the edge and pairs each patch with the next one on its back side, as the faces of one
// solid. Appends the pairs of patches; false, with no pairs, when fronts and backs don't alternate:
// then the edge bounds no solid. Patches at the same angle come in the order that alternates.
bool pair_around_edge(Vec3 low, Vec3 high, const std::vector<EdgePatch>& patches,
                      std::vector<std::pair<int32_t, int32_t>>& pairs);

}  // namespace hrad
