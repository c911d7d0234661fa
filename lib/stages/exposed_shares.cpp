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
  std::vector<Node>& nodes = state.forest.nodes;
  const LinkSampler sampler(state.forest, tools.engine, tools.exposure, tools.oracle.seed,
                            tools.oracle.near_ratio);
  const auto surface_of = [&](size_t k) { return nodes[elements[k]].surface; };
  const auto name_of = [&](size_t k) { return name_of_element(state.forest, elements[k]); };
  std::vector<float> exposed(elements.size(), 0.0f);
  std::vector<uint8_t> is_new(elements.size(), 0);
  state.journal.next_pass();
  const bool going_on = state.journal.for_each(
      tools.team, static_cast<int64_t>(elements.size()),
      [&](int64_t task, int) {
        const size_t k = static_cast<size_t>(task);
        if (!tools.exchange.mine(surface_of(k))) return;
        const Surface& surface = state.forest.surfaces[surface_of(k)];
        exposed[k] = 1;
        if (!tools.exposure.can_be_sealed(surface.patch, surface.side)) return;
        is_new[k] = !state.journal.known(
            name_of(k), [&](KnownResult& known) { return take_share(known, exposed[k]); });
        if (is_new[k]) exposed[k] = sampler.exposed_share(nodes[elements[k]]);
      },
      [&](int64_t) { return tools.progress(0); },
      [&](LinkStep& step, int64_t task) {
        const size_t k = static_cast<size_t>(task);
        if (!is_new[k]) return;
        put(step.results, &exposed[k], 1);
        step.end_task(name_of(k));
      });
  if (!tools.exchange.all_go_on(going_on)) return false;
  tools.exchange.share(exposed, surface_of);
  for (size_t k = 0; k < exposed.size(); ++k) nodes[elements[k]].exposed = exposed[k];
  return true;
}

}  // namespace hrad
