// Passes over the levels of clusters. Floor 7 (stages).
#include "stages/cluster_round.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "stages/cluster_refiner.h"
#include "stages/exchange.h"

namespace hrad {
namespace {

struct Task {
  NodeId cluster;
  std::vector<NodeId> met;
};

void add_result(LinkStep& step, uint64_t name, const ClusterResult& result) {
  put(step.results, &result.rays, 1);
  put_list(step.results, result.run);
  put_list(step.results, result.down);
  step.end_task(name);
}

// False: that is no result of a cluster.
bool take_result(KnownResult& known, size_t nodes, ClusterResult& taken) {
  const auto is_node = [&](NodeId id) { return id >= 0 && static_cast<size_t>(id) < nodes; };
  ClusterResult result;
  const bool is_good = known.take(&result.rays, 1) && is_count(result.rays) &&
                       known.take_list(result.run) && known.take_list(result.down) &&
                       known.at_end() && are_links(result.run, is_node) &&
                       std::all_of(result.down.begin(), result.down.end(), is_node);
  if (is_good) taken = std::move(result);
  return is_good;
}

}  // namespace

bool refine_clusters(State& state, const StageTools& tools, const Brightness& brightness,
                     const LightOfAll& radiosity, const EndPointsTable& points,
                     Span<const NodeId> met, StageMemory& memory, ClusterRound& round) {
  const Forest& forest = state.forest;
  const NodeId first = static_cast<NodeId>(forest.surface_count());
  round.runs.resize(forest.clusters.clusters.size());
  round.met.resize(static_cast<size_t>(first));
  std::vector<std::unique_ptr<ClusterRefiner>> refiners(tools.team.size());
  for (auto& refiner : refiners)
    refiner = std::make_unique<ClusterRefiner>(state, tools, brightness, radiosity, points);
  std::vector<Task> tasks;
  tasks.push_back({forest.top(), {met.begin(), met.end()}});
  while (!tasks.empty()) {
    std::vector<ClusterResult> results(tasks.size());
    std::vector<size_t> own;
    for (size_t k = 0; k < tasks.size(); ++k)
      if (tools.exchange.mine(forest, tasks[k].cluster)) own.push_back(k);
    std::vector<uint8_t> is_new(tasks.size(), 0);
    const auto name_of = [&](size_t k) { return static_cast<uint64_t>(tasks[k].cluster); };
    state.journal.next_pass();
    const bool going_on = state.journal.for_each(
        tools.team, static_cast<int64_t>(own.size()),
        [&](int64_t turn, int worker) {
          const size_t k = own[static_cast<size_t>(turn)];
          is_new[k] = !state.journal.known(name_of(k), [&](KnownResult& known) {
            return take_result(known, forest.nodes.size(), results[k]);
          });
          if (is_new[k]) results[k] = refiners[worker]->refine(tasks[k].cluster, tasks[k].met);
          memory.take(static_cast<int64_t>(results[k].run.size() * sizeof(Link) +
                                           2 * results[k].down.size() * sizeof(NodeId)),
                      "links of clusters");
        },
        [&](int64_t) { return tools.progress(0); },
        [&](LinkStep& step, int64_t turn) {
          const size_t k = own[static_cast<size_t>(turn)];
          if (is_new[k]) add_result(step, name_of(k), results[k]);
        });
    if (!tools.exchange.all_go_on(going_on)) return false;
    std::vector<std::vector<Link>> runs;
    std::vector<std::vector<NodeId>> down;
    for (ClusterResult& result : results) {
      round.rays += result.rays;
      runs.push_back(std::move(result.run));
      down.push_back(std::move(result.down));
    }
    const auto surface_of = [&](size_t k) {
      return Exchange::surface_of(forest, tasks[k].cluster);
    };
    tools.exchange.share_lists(runs, surface_of);
    tools.exchange.share_lists(down, surface_of);
    std::vector<Task> next;
    for (size_t k = 0; k < tasks.size(); ++k) {
      const NodeId cluster = tasks[k].cluster;
      round.runs[cluster - first] = std::move(runs[k]);
      for (NodeId child : forest.cluster(forest.nodes[cluster]).child) {
        if (child < first)
          round.met[child] = down[k];
        else
          next.push_back({child, down[k]});
      }
    }
    tasks = std::move(next);
  }
  return true;
}

}  // namespace hrad
