// A round of refinement above the roots: the links of the clusters, from the top down, and what is
// left for the roots to be linked with. Floor 7 (stages).
#pragma once

#include <vector>

#include "links/end_points.h"
#include "stages/light_of_all.h"
#include "stages/state.h"
#include "stages/state_memory.h"

namespace hrad {

struct ClusterRound {
  std::vector<std::vector<Link>> runs;   // of the clusters, in their order
  std::vector<std::vector<NodeId>> met;  // per root: sources that it has yet to meet
  int64_t rays = 0;
};

// One pass for each level of clusters; a task is one cluster, which reads the frozen state. met: by
// the top from outside. False: stopped by tools.progress. Of the state only the journal changes.
bool refine_clusters(State& state, const StageTools& tools, const Brightness& brightness,
                     const LightOfAll& radiosity, const EndPointsTable& points,
                     Span<const NodeId> met, StageMemory& memory, ClusterRound& round);

}  // namespace hrad
