// Passes over the levels of clusters. Floor 7 (stages).
#include "stages/cluster_round.h"

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

}  // namespace

bool refine_clusters(const State& state, const StageTools& tools, const Brightness& brightness,
                     const EndPointsTable& points, Span<const NodeId> met, StageMemory& memory,
                     ClusterRound& round) {
  const Forest& forest = state.forest;
  const NodeId first = static_cast<NodeId>(forest.surface_count());
  round.runs.resize(forest.clusters.clusters.size());
  round.met.resize(static_cast<size_t>(first));
  std::vector<std::unique_ptr<ClusterRefiner>> refiners(tools.team.size());
  for (auto& refiner : refiners)
    refiner = std::make_unique<ClusterRefiner>(state, tools, brightness, points);
  std::vector<Task> tasks;
  tasks.push_back({forest.top(), {met.begin(), met.end()}});
  while (!tasks.empty()) {
    std::vector<ClusterResult> results(tasks.size());
    std::vector<size_t> own;
    for (size_t k = 0; k < tasks.size(); ++k)
      if (tools.exchange.mine(forest, tasks[k].cluster)) own.push_back(k);
    const bool going_on = tools.team.for_each(
        static_cast<int64_t>(own.size()),
        [&](int64_t turn, int worker) {
          const size_t k = own[static_cast<size_t>(turn)];
          results[k] = refiners[worker]->refine(tasks[k].cluster, tasks[k].met);
          memory.take(static_cast<int64_t>(results[k].run.size() * sizeof(Link) +
                                           2 * results[k].down.size() * sizeof(NodeId)),
                      "links of clusters");
        },
        [&](int64_t) { return tools.progress(0); });
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
