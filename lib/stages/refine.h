// Refinement (paper, Section 2, Iterative Stage): every link is weighed by the oracle against the
// radiosity of the round before; where it is too coarse the receiver is split or the source
// descended. Floor 7 (stages).
#pragma once

#include "stages/light_of_all.h"
#include "stages/state.h"

namespace hrad {

// One round over all links. A task is the subtree of one receiver, which it alone writes; it reads
// the frozen state of the round before, so no lock is needed and the result depends on no order.
// Receivers with many links are cut into the subtrees of their children, which follow in a further
// pass. New elements come after the old ones, in task order, with their parent's radiosity.
// False: stopped by tools.progress; the state is as it was before. work, if wanted: CPU that
// each surface of this process's own took, in seconds.
bool refine_links(State& state, const StageTools& tools, const Brightness& brightness,
                  const LightOfAll& radiosity, std::vector<double>* work = nullptr);

// The first round of linking=clusters: from the link of all surfaces with themselves. The forest
// has its clusters and no elements yet.
bool link_clusters(State& state, const StageTools& tools, const Brightness& brightness);

}  // namespace hrad
