// Passes over the levels of clusters. Floor 7 (stages).
#include "stages/cluster_round.h"

#include <memory>
#include <utility>

#include "stages/cluster_refiner.h"

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
    const bool going_on = tools.team.for_each(
        static_cast<int64_t>(tasks.size()),
        [&](int64_t k, int worker) {
          results[k] = refiners[worker]->refine(tasks[k].cluster, tasks[k].met);
          memory.take(static_cast<int64_t>(results[k].run.size() * sizeof(Link) +
                                           2 * results[k].down.size() * sizeof(NodeId)),
                      "links of clusters");
        },
        [&](int64_t) { return tools.progress(0); });
    if (!going_on) return false;
    std::vector<Task> next;
    for (size_t k = 0; k < tasks.size(); ++k) {
      const NodeId cluster = tasks[k].cluster;
      round.runs[cluster - first] = std::move(results[k].run);
      round.rays += results[k].rays;
      for (NodeId child : forest.cluster(forest.nodes[cluster]).child) {
        if (child < first)
          round.met[child] = results[k].down;
        else
          next.push_back({child, results[k].down});
      }
    }
    tasks = std::move(next);
  }
  return true;
}

}  // namespace hrad
