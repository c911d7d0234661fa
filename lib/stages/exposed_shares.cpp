// An element is a task; what took looks at a border is kept in the journal. Floor 7 (stages).
#include "stages/exposed_shares.h"

#include "links/link_sampler.h"
#include "machine/pieces.h"
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
  NodeArray& nodes = state.forest.nodes;
  const LinkSampler sampler(state.forest, tools.engine, tools.exposure, tools.oracle.seed,
                            tools.oracle.near_ratio);
  const auto can_be_sealed = [&](NodeId id) {
    const Surface& surface = state.forest.surfaces[nodes[id].surface];
    return tools.exposure.can_be_sealed(surface.patch, surface.side);
  };
  const std::vector<NodeId> looked_at =
      gathered<NodeId>(tools.team, elements.size(), [&](size_t k, std::vector<NodeId>& some) {
        if (can_be_sealed(elements[k])) some.push_back(elements[k]);
      });
  // All want to know all of them: each takes its turns, whosever the elements are.
  std::vector<float> exposed(looked_at.size(), 0.0f);
  std::vector<size_t> own;
  for (size_t k = 0; k < looked_at.size(); ++k)
    if (tools.exchange.my_turn(static_cast<int64_t>(k))) own.push_back(k);
  const auto element = [&](size_t task) { return looked_at[own[task]]; };
  const auto share = [&](size_t task) -> float& { return exposed[own[task]]; };
  const bool going_on = state.journal.next_pass_of(
      tools.team, own.size(),
      {[&](size_t task) { return name_of_element(state.forest, element(task)); },
       [&](size_t task, KnownResult& known) { return take_share(known, share(task)); },
       [&](size_t task, int) { share(task) = sampler.exposed_share(nodes[element(task)]); },
       [&](size_t task, Bytes& bytes) { put(bytes, &share(task), 1); }},
      [&](int64_t) { return tools.progress(0); });
  if (!tools.exchange.all_go_on(going_on)) return false;
  tools.exchange.share_turns(exposed, tools.team);
  for_each_thing(tools.team, elements.size(), [&](size_t k) {
    if (!can_be_sealed(elements[k])) nodes.set_exposed(elements[k], 1);
  });
  for_each_thing(tools.team, exposed.size(),
                 [&](size_t k) { nodes.set_exposed(looked_at[k], exposed[k]); });
  return true;
}

}  // namespace hrad
