// Which patches bound a closed solid: decided once per scene from its edges, so that a ray that
// meets a back face can prove that its origin lies inside a solid. Floor 3 (scene).
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec3.h"
#include "scene/scene.h"

namespace hrad {

struct Solids {
  // Per patch the number of its connected component (through edges; vertices welded by position).
  std::vector<int32_t> component;
  // Per component: every edge is shared by exactly two patches that run along it in opposite
  // directions (where solids touch, two of each, told apart by their angles around the edge), all
  // of them one-sided (blockers included), none dropped: the component has an inside.
  std::vector<uint8_t> closed;
  // Per component: its signed volume (positive: fronts face outward; negative: a room seen from
  // within), 0 when not closed.
  std::vector<double> volume;
  std::vector<Box> box;
};

Solids find_solids(const Scene& scene);

}  // namespace hrad
