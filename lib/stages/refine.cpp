// Tasks, passes and the numbering of new elements. Floor 7 (stages).
#include "stages/refine.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "stages/cluster_round.h"
#include "stages/exchange.h"
#include "stages/new_elements.h"
#include "stages/state_memory.h"
#include "stages/subtree_refiner.h"
#include "stages/sweep.h"

namespace hrad {
namespace {

// A receiver subtree with more links than this is cut into its children's, so that no task holds up
// the others.
constexpr int64_t most_links_of_a_task = 200;

struct Task {
  NodeId root;
  std::vector<Link> arriving;
  std::vector<NodeId> met;  // SubtreeRefiner's
  int64_t work = 0;         // about: the links it begins with
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

// One round, pass after pass: first all surfaces, then the children of those that were cut.
class RefiningRound {
 public:
  RefiningRound(State& state, const StageTools& tools, const Brightness& brightness)
      : state_(state),
        tools_(tools),
        exchange_(tools.exchange),
        brightness_(brightness),
        weight_(subtree_links(state)),
        work_(state.forest.surfaces.size(), 0.0),
        memory_(state) {}

  // met: by the top of the clusters from outside. False: stopped, and nothing has changed.
  bool run(Span<const NodeId> met);

  // Rays that each of this process's own surfaces took.
  const std::vector<double>& work() const { return work_; }

 private:
  bool start(Span<const NodeId> met);
  bool pass();
  void store(std::vector<SubtreeResult> results);
  void finish();
  bool mine(const Task& task) const {
    return exchange_.mine(state_.forest.nodes[task.root].surface);
  }

  State& state_;
  const StageTools& tools_;
  const Exchange& exchange_;
  const Brightness& brightness_;
  const std::vector<int64_t> weight_;  // of the nodes there were
  std::vector<double> work_;           // rays of each surface
  StageMemory memory_;
  std::unique_ptr<EndPointsTable> points_;
  ClusterRound clusters_;
  std::vector<Task> tasks_;
  bool first_pass_ = true;
  // Of all passes, until they replace the old links.
  std::vector<std::vector<SubtreeResult>> results_;
  std::vector<LinkTable::NewRun> new_links_;
};

bool RefiningRound::run(Span<const NodeId> met) {
  if (!start(met)) return false;
  while (!tasks_.empty())
    if (!pass()) return false;
  finish();
  return true;
}

bool RefiningRound::start(Span<const NodeId> met) {
  tasks_.resize(static_cast<size_t>(state_.forest.surface_count()));
  for (size_t k = 0; k < tasks_.size(); ++k) tasks_[k].root = static_cast<NodeId>(k);
  if (state_.forest.clusters.empty()) return true;
  const PointPlacer placer{state_.forest, tools_.exposure, tools_.engine.center(),
                           tools_.engine.offset()};
  points_ = std::make_unique<EndPointsTable>(placer, tools_.team);
  memory_.take(points_->bytes(), "sample points of clusters");
  if (!refine_clusters(state_, tools_, brightness_, *points_, met, memory_, clusters_))
    return false;
  for (size_t k = 0; k < tasks_.size(); ++k) tasks_[k].met = std::move(clusters_.met[k]);
  return true;
}

bool RefiningRound::pass() {
  std::vector<size_t> own;
  for (size_t k = 0; k < tasks_.size(); ++k) {
    Task& task = tasks_[k];
    if (!mine(task)) continue;
    own.push_back(k);
    const size_t root = static_cast<size_t>(task.root);
    task.work = (root < weight_.size() ? weight_[root] : 0) +
                static_cast<int64_t>(task.arriving.size() + task.met.size());
  }
  // Large ones first: the last ones to end are small.
  std::stable_sort(own.begin(), own.end(),
                   [&](size_t a, size_t b) { return tasks_[a].work > tasks_[b].work; });
  std::vector<SubtreeResult> results(tasks_.size());
  std::vector<std::unique_ptr<SubtreeRefiner>> refiners(tools_.team.size());
  for (auto& refiner : refiners)
    refiner = std::make_unique<SubtreeRefiner>(state_, tools_, brightness_, points_.get());
  const bool going_on = tools_.team.for_each(
      static_cast<int64_t>(own.size()),
      [&](int64_t turn, int worker) {
        const size_t k = own[static_cast<size_t>(turn)];
        const Task& task = tasks_[k];
        results[k] = refiners[worker]->refine(task.root, task.arriving, task.met,
                                              task.work > most_links_of_a_task);
        memory_.take(bytes_of(results[k]), "refined links");
      },
      [&](int64_t done) {
        // Later passes are always carried to their end: nothing may be left of a round half done.
        if (!first_pass_) return true;
        return tools_.progress(static_cast<double>(done) / static_cast<double>(own.size()));
      });
  if (!exchange_.all_go_on(going_on)) return false;
  first_pass_ = false;
  store(std::move(results));
  return true;
}

void RefiningRound::store(std::vector<SubtreeResult> results) {
  const auto surface_of = [&](size_t k) { return state_.forest.nodes[tasks_[k].root].surface; };
  std::vector<std::vector<NewFamily>> families(results.size());
  std::vector<uint8_t> handed_on(results.size());
  tools_.team.for_each(static_cast<int64_t>(results.size()), [&](int64_t k, int) {
    families[k] = new_families(results[k]);
    handed_on[k] = results[k].handed_on;
  });
  exchange_.share_lists(families, surface_of);
  exchange_.share(handed_on, surface_of);
  const std::vector<NodeId> first = add_families(state_, families, tools_.team);
  state_.links.resize(state_.forest.nodes.size());
  std::vector<Task> next;
  for (size_t k = 0; k < results.size(); ++k) {
    SubtreeResult& result = results[k];
    state_.rays += result.rays;
    work_[static_cast<size_t>(surface_of(k))] += static_cast<double>(result.rays);
    const size_t kept = handed_on[k] ? 1 : result.nodes.size();
    NodeId made = first[k];
    for (size_t at = 0; at < kept && at < result.nodes.size(); ++at) {
      const NodeId old = result.nodes[at].old_id;
      new_links_.push_back({old >= 0 ? old : made++, result.nodes[at].run});
    }
    if (!handed_on[k]) continue;
    const NodeId child = state_.forest.nodes[tasks_[k].root].first_child;
    for (int32_t c = 0; c < 4; ++c) {
      next.push_back({child + c, {}, {}});
      if (result.nodes.empty()) continue;  // another's
      SubtreeNode& node = result.nodes[static_cast<size_t>(result.nodes[0].first_child + c)];
      next.back().arriving = std::move(node.arriving);
      next.back().met = std::move(node.meeting);
    }
  }
  results_.push_back(std::move(results));
  tasks_ = std::move(next);
}

void RefiningRound::finish() {
  const NodeId first = static_cast<NodeId>(state_.forest.surface_count());
  for (size_t k = 0; k < clusters_.runs.size(); ++k)
    new_links_.push_back({first + static_cast<NodeId>(k), clusters_.runs[k]});
  state_.rays += clusters_.rays;
  int64_t links = 0;
  for (const LinkTable::NewRun& run : new_links_) links += static_cast<int64_t>(run.links.size());
  // In two places for a while, though old ones go as new ones come.
  memory_.take(
      std::max<int64_t>(0, links - state_.links.link_count()) * static_cast<int64_t>(sizeof(Link)),
      "refined links");
  state_.links.replace(std::move(new_links_));
  results_.clear();
  pull_exposure(state_.forest);
  measure_clusters(state_.forest);
  // What turned out to be sealed all over receives nothing.
  std::vector<LinkTable::NewRun> sealed;
  for (size_t k = 0; k < state_.forest.nodes.size(); ++k)
    if (state_.forest.nodes[k].exposed <= 0 && !state_.forest.is_leaf(static_cast<NodeId>(k)) &&
        state_.links[k].count() > 0)
      sealed.push_back({static_cast<NodeId>(k), {}});
  state_.links.replace(std::move(sealed));
  shrink_to_fit(state_);
  memory_.settle();
  tools_.exchange.ask_for_sources(state_);
}

}  // namespace

bool link_clusters(State& state, const StageTools& tools, const Brightness& brightness) {
  const NodeId top = state.forest.top();
  RefiningRound round(state, tools, brightness);
  return round.run({&top, 1});
}

bool refine_links(State& state, const StageTools& tools, const Brightness& brightness,
                  std::vector<double>* work) {
  RefiningRound round(state, tools, brightness);
  if (!round.run({})) return false;
  if (work) *work = round.work();
  return true;
}

}  // namespace hrad
