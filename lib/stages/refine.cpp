// Tasks, passes and the numbering of new elements. Floor 7 (stages).
#include "stages/refine.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "stages/cluster_round.h"
#include "stages/exchange.h"
#include "stages/state_memory.h"
#include "stages/subtree_refiner.h"
#include "stages/sweep.h"

namespace hrad {
namespace {

// A receiver subtree with more links than this is cut into its children's.
constexpr int64_t most_links_of_a_task = 20000;

struct Task {
  NodeId root;
  std::vector<Link> arriving;
  std::vector<NodeId> met;  // SubtreeRefiner's
};

// Links of every node and all below it.
std::vector<int64_t> subtree_links(const State& state) {
  std::vector<int64_t> count(state.forest.nodes.size());
  for (size_t k = 0; k < count.size(); ++k) count[k] = state.links[k].count();
  for (size_t k = count.size(); k-- > 0;) {
    const NodeId parent = state.forest.nodes[k].parent;
    if (parent >= 0) count[parent] += count[k];
  }
  return count;
}

int64_t bytes_of(const SubtreeResult& result) {
  size_t bytes = result.nodes.size() * sizeof(SubtreeNode);
  for (const SubtreeNode& node : result.nodes)
    bytes += (node.run.size() + node.arriving.size()) * sizeof(Link);
  return static_cast<int64_t>(bytes);
}

// The elements that tasks have made, known to all; links stay with the owners of their receivers.
void share_elements(std::vector<SubtreeResult>& results, const std::vector<Task>& tasks,
                    const State& state, const Exchange& exchange) {
  if (exchange.alone()) return;
  struct Made {
    Node place;
    NodeId old_id;
    int32_t parent, first_child;
  };
  const auto surface_of = [&](size_t k) { return state.forest.nodes[tasks[k].root].surface; };
  std::vector<uint8_t> handed_on;
  std::vector<std::vector<Made>> made(results.size());
  for (size_t k = 0; k < results.size(); ++k) {
    handed_on.push_back(results[k].handed_on ? 1 : 0);
    bool any = results[k].handed_on;
    for (const SubtreeNode& node : results[k].nodes) any = any || node.old_id < 0;
    if (!any) continue;
    for (const SubtreeNode& node : results[k].nodes)
      made[k].push_back({node.place, node.old_id, node.parent, node.first_child});
  }
  exchange.share(handed_on, surface_of);
  exchange.share_lists(made, surface_of);
  for (size_t k = 0; k < results.size(); ++k) {
    if (exchange.mine(surface_of(k))) continue;
    results[k].handed_on = handed_on[k] != 0;
    for (const Made& from : made[k]) {
      SubtreeNode node;
      node.place = from.place;
      node.old_id = from.old_id;
      node.parent = from.parent;
      node.first_child = from.first_child;
      results[k].nodes.push_back(std::move(node));
    }
  }
}

// Gives the new elements of a task their numbers; new_links: of all its elements, if they are mine.
void store(State& state, SubtreeResult& result, bool mine,
           std::vector<LinkTable::NewRun>& new_links, std::vector<Task>& next) {
  Forest& forest = state.forest;
  std::vector<NodeId> id(result.nodes.size());
  for (size_t at = 0; at < result.nodes.size(); ++at) {
    SubtreeNode& node = result.nodes[at];
    if (node.old_id >= 0) {
      id[at] = node.old_id;
    } else {
      id[at] = static_cast<NodeId>(forest.nodes.size());
      Node made = node.place;
      made.parent = id[node.parent];
      made.first_child = -1;
      forest.nodes.push_back(made);
      const size_t from = static_cast<size_t>(made.parent) * state.bands;
      for (int band = 0; band < state.bands; ++band) {
        state.radiosity.push_back(state.radiosity[from + band]);
        state.irradiance.push_back(state.irradiance[from + band]);
      }
    }
    if (mine && !(result.handed_on && at > 0)) new_links.push_back({id[at], node.run});
  }
  for (size_t at = 0; at < result.nodes.size(); ++at) {
    const SubtreeNode& node = result.nodes[at];
    if (node.first_child < 0) continue;
    forest.nodes[id[at]].first_child = id[node.first_child];
  }
  if (result.handed_on)
    for (int child = 0; child < 4; ++child) {
      const int32_t at = result.nodes[0].first_child + child;
      next.push_back({id[at], std::move(result.nodes[at].arriving), {}});
    }
}

void store(State& state, const ClusterRound& round, std::vector<LinkTable::NewRun>& new_links) {
  const NodeId first = static_cast<NodeId>(state.forest.surface_count());
  for (size_t k = 0; k < round.runs.size(); ++k)
    new_links.push_back({first + static_cast<NodeId>(k), round.runs[k]});
  state.rays += round.rays;
}

// met: by the top of the clusters from outside.
bool refine(State& state, const StageTools& tools, const Brightness& brightness,
            Span<const NodeId> met) {
  std::vector<Task> tasks(state.forest.surface_count());
  for (size_t k = 0; k < tasks.size(); ++k) tasks[k].root = static_cast<NodeId>(k);
  ClusterRound clusters;
  std::unique_ptr<EndPointsTable> points;
  StageMemory memory_of_clusters(state);
  if (!state.forest.clusters.empty()) {
    const PointPlacer placer{state.forest, tools.exposure, tools.engine.center(),
                             tools.engine.offset()};
    points = std::make_unique<EndPointsTable>(placer, tools.team);
    memory_of_clusters.take(points->bytes(), "sample points of clusters");
    if (!refine_clusters(state, tools, brightness, *points, met, memory_of_clusters, clusters))
      return false;
    for (size_t k = 0; k < tasks.size(); ++k) tasks[k].met = std::move(clusters.met[k]);
  }
  int64_t finished = 0;
  while (!tasks.empty()) {
    StageMemory memory(state);
    const std::vector<int64_t> weight = subtree_links(state);
    std::vector<SubtreeResult> results(tasks.size());
    std::vector<std::unique_ptr<SubtreeRefiner>> refiners(tools.team.size());
    for (auto& refiner : refiners)
      refiner = std::make_unique<SubtreeRefiner>(state, tools, brightness, points.get());
    std::vector<size_t> own;
    for (size_t k = 0; k < tasks.size(); ++k)
      if (tools.exchange.mine(state.forest.nodes[tasks[k].root].surface)) own.push_back(k);
    const bool going_on = tools.team.for_each(
        static_cast<int64_t>(own.size()),
        [&](int64_t turn, int worker) {
          const size_t k = own[static_cast<size_t>(turn)];
          const Task& task = tasks[k];
          const int64_t work =
              weight[task.root] + static_cast<int64_t>(task.arriving.size() + task.met.size());
          results[k] = refiners[worker]->refine(task.root, task.arriving, task.met,
                                                work > most_links_of_a_task);
          memory.take(bytes_of(results[k]), "refined links");
        },
        [&](int64_t done) {
          // Later passes are small beside the first. They are always carried to their end: nothing
          // may be left of a round half done.
          if (finished > 0) return true;
          return tools.progress(static_cast<double>(done) / static_cast<double>(own.size()));
        });
    if (!tools.exchange.all_go_on(going_on)) return false;
    share_elements(results, tasks, state, tools.exchange);
    std::vector<Task> next;
    std::vector<LinkTable::NewRun> new_links;
    if (finished == 0) store(state, clusters, new_links);
    int64_t links = 0;
    for (size_t k = 0; k < results.size(); ++k) {
      state.rays += results[k].rays;
      store(state, results[k], tools.exchange.mine(state.forest.nodes[tasks[k].root].surface),
            new_links, next);
      for (const SubtreeNode& node : results[k].nodes)
        links += static_cast<int64_t>(node.run.size());
    }
    // In two places for a while, though old ones go as new ones come.
    memory.take(
        std::max<int64_t>(0, links - state.links.link_count()) * static_cast<int64_t>(sizeof(Link)),
        "refined links");
    state.links.resize(state.forest.nodes.size());
    state.links.replace(std::move(new_links));
    shrink_to_fit(state);
    memory.settle();
    finished += static_cast<int64_t>(tasks.size());
    tasks = std::move(next);
  }
  pull_exposure(state.forest);
  measure_clusters(state.forest);
  // What turned out to be sealed all over receives nothing.
  std::vector<LinkTable::NewRun> sealed;
  for (size_t k = 0; k < state.forest.nodes.size(); ++k)
    if (state.forest.nodes[k].exposed <= 0 && !state.forest.is_leaf(static_cast<NodeId>(k)) &&
        state.links[k].count() > 0)
      sealed.push_back({static_cast<NodeId>(k), {}});
  state.links.replace(std::move(sealed));
  tools.exchange.ask_for_sources(state);
  return true;
}

}  // namespace

bool link_clusters(State& state, const StageTools& tools, const Brightness& brightness) {
  const NodeId top = state.forest.top();
  return refine(state, tools, brightness, {&top, 1});
}

bool refine_links(State& state, const StageTools& tools, const Brightness& brightness) {
  return refine(state, tools, brightness, {});
}

}  // namespace hrad
