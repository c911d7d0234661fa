// Sweeping above the roots: light pushed from the clusters down to them, and pulled up again.
// Nothing happens where there are no clusters. Floor 7 (stages).
#pragma once

#include "stages/state.h"

namespace hrad {

// Makes what arrives on every cluster include what arrives on those above it.
void push_to_roots(State& state);

// Radiosity and irradiance of the clusters: means over the exposed parts of what they hold.
void pull_to_clusters(State& state);

// The same of brightness, and spread as the root mean square deviation within a cluster.
void brighten_clusters(const Forest& forest, Brightness& brightness);
void spread_to_clusters(const Forest& forest, Brightness& brightness);

}  // namespace hrad
