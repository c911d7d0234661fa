// Links: who sends light to whom. A link belongs to its receiver and names its source; its weight
// is form factor times visible fraction, from receiver to source, so that the irradiance it brings
// is weight times the source's radiosity. Floor 6 (links).
#pragma once

#include "hierarchy/forest.h"

namespace hrad {

struct Link {
  NodeId source;
  float weight;
};
static_assert(sizeof(Link) == 8, "a link is eight bytes");

// No surface sends more than all of its light to one receiver; form factors have some noise.
constexpr float largest_weight = 4;

}  // namespace hrad
