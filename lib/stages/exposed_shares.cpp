// An element is a task; what took looks at a border is kept in the journal. Floor 7 (stages).
#include "stages/exposed_shares.h"

#include "links/link_sampler.h"
#include "stages/exchange.h"
#include "stages/task_names.h"

namespace hrad {
namespace {

bool take_share(KnownResult& known, float& share) {
  float of_file = 0;
  if (!known.take(&of_file, 1) || !known.at_end() || !(of_file >= 0 && of_file <= 1)) return false;
  share = of_file;
  return true;
}

}  // namespace

bool measure_exposure(State& state, const StageTools& tools, const std::vector<NodeId>& elements) {
  GrowingArray<Node>& nodes = state.forest.nodes;
  const LinkSampler sampler(state.forest, tools.engine, tools.exposure, tools.oracle.seed,
                            tools.oracle.near_ratio);
  const auto surface_of = [&](size_t k) { return nodes[elements[k]].surface; };
  std::vector<float> exposed(elements.size(), 0.0f);
  std::vector<size_t> looked_at;  // of the own ones; the others are exposed all over
  for (size_t k = 0; k < elements.size(); ++k) {
    if (!tools.exchange.mine(surface_of(k))) continue;
    exposed[k] = 1;
    const Surface& surface = state.forest.surfaces[surface_of(k)];
    if (tools.exposure.can_be_sealed(surface.patch, surface.side)) looked_at.push_back(k);
  }
  const auto element = [&](size_t task) { return elements[looked_at[task]]; };
  const auto share = [&](size_t task) -> float& { return exposed[looked_at[task]]; };
  const bool going_on = state.journal.next_pass_of(
      tools.team, looked_at.size(),
      {[&](size_t task) { return name_of_element(state.forest, element(task)); },
       [&](size_t task, KnownResult& known) { return take_share(known, share(task)); },
       [&](size_t task, int) { share(task) = sampler.exposed_share(nodes[element(task)]); },
       [&](size_t task, Bytes& bytes) { put(bytes, &share(task), 1); }},
      [&](int64_t) { return tools.progress(0); });
  if (!tools.exchange.all_go_on(going_on)) return false;
  tools.exchange.share(exposed, surface_of);
  for (size_t k = 0; k < exposed.size(); ++k) nodes[elements[k]].exposed = exposed[k];
  return true;
}

}  // namespace hrad
