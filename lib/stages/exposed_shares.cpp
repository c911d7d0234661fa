// An element is a task. Floor 7 (stages).
#include "stages/exposed_shares.h"

#include "links/link_sampler.h"
#include "stages/exchange.h"

namespace hrad {

void measure_exposure(State& state, const StageTools& tools, const std::vector<NodeId>& elements) {
  std::vector<Node>& nodes = state.forest.nodes;
  const LinkSampler sampler(state.forest, tools.engine, tools.exposure, tools.oracle.seed,
                            tools.oracle.near_ratio);
  const auto surface_of = [&](size_t k) { return nodes[elements[k]].surface; };
  std::vector<float> exposed(elements.size(), 0.0f);
  tools.team.for_each(static_cast<int64_t>(elements.size()), [&](int64_t k, int) {
    if (tools.exchange.mine(surface_of(k))) exposed[k] = sampler.exposed_share(nodes[elements[k]]);
  });
  tools.exchange.share(exposed, surface_of);
  for (size_t k = 0; k < exposed.size(); ++k) nodes[elements[k]].exposed = exposed[k];
}

}  // namespace hrad
