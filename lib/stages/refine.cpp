// Tasks, passes and the numbering of new elements. Floor 7 (stages).
#include "stages/refine.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "machine/process_usage.h"
#include "stages/cluster_round.h"
#include "stages/exchange.h"
#include "stages/new_elements.h"
#include "stages/state_memory.h"
#include "stages/subtree_record.h"
#include "stages/subtree_refiner.h"
#include "stages/sweep.h"
#include "stages/task_names.h"

namespace hrad {
namespace {

// A receiver subtree with more links than this is cut into its children's, so that no task holds up
// the others.
constexpr int64_t most_links_of_a_task = 200;
// Links of a partly sealed element, in links of others.
constexpr int64_t work_of_partly_sealed = 8;
// For a link, the work of a task that hands on, and what it leaves to all that come after it, in
// that of a link of others.
constexpr double work_of_handing_on = 0.06, left_by_handing_on = 0.45;

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

// One round, pass after pass: first all surfaces, then the children of those that were cut. Every
// owner makes its passes alone, as no task sees what others have made; the elements have numbers of
// its own until all owners are through.
class RefiningRound {
 public:
  RefiningRound(State& state, const StageTools& tools, const Brightness& brightness,
                const LightOfAll& radiosity)
      : state_(state),
        tools_(tools),
        exchange_(tools.exchange),
        brightness_(brightness),
        radiosity_(radiosity),
        old_nodes_(state.forest.nodes.size()),
        weight_(subtree_links(state)),
        work_(state.forest.surfaces.size(), 0.0),
        memory_(state) {}

  // met: by the top of the clusters from outside. False: stopped, and nothing has changed.
  bool run(Span<const NodeId> met);

  // CPU that each of this process's own surfaces took, s.
  const std::vector<double>& work() const { return work_; }

 private:
  // What the own tasks of a pass have made, in the order of the tasks.
  struct Pass {
    std::vector<NodeId> roots;
    std::vector<SubtreeResult> results;
    std::vector<std::vector<NewFamily>> families;
    std::vector<NodeId> first;  // number of the first new element of each
  };

  bool start(Span<const NodeId> met);
  bool pass();
  std::vector<size_t> by_work();
  static bool hands_on(const Task& task) { return task.work > most_links_of_a_task; }
  static double work_of(const Task& task);
  static double left_by(const Task& task);
  std::vector<double> work_in(const std::vector<size_t>& order) const;
  double share_of_pass() const;
  void store(std::vector<SubtreeResult> results);
  void number_anew();
  void finish();

  State& state_;
  const StageTools& tools_;
  Exchange& exchange_;
  const Brightness& brightness_;
  const LightOfAll& radiosity_;
  const size_t old_nodes_;
  const std::vector<int64_t> weight_;  // of the old nodes
  std::vector<double> work_;           // CPU of each own surface, s
  StageMemory memory_;
  std::unique_ptr<EndPointsTable> points_;
  ClusterRound clusters_;
  std::vector<Task> tasks_;  // own ones of the next pass
  double share_ = 0;         // of the round that is done, for who waits for it
  std::vector<Pass> passes_;
  std::vector<LinkTable::NewRun> new_links_;
};

bool RefiningRound::run(Span<const NodeId> met) {
  if (!start(met)) return false;
  state_.nodes_in_order = static_cast<int64_t>(old_nodes_);
  bool going_on = true;
  while (going_on && !tasks_.empty()) going_on = pass();
  going_on = exchange_.all_go_on(going_on);
  if (going_on)
    finish();
  else
    drop_elements(state_, old_nodes_);
  state_.nodes_in_order = -1;
  return going_on;
}

bool RefiningRound::start(Span<const NodeId> met) {
  for (NodeId root = 0; root < state_.forest.surface_count(); ++root)
    if (exchange_.mine(root)) tasks_.push_back({root, {}, {}});
  if (state_.forest.clusters.empty()) return true;
  const PointPlacer placer{state_.forest, tools_.exposure, tools_.engine.center(),
                           tools_.engine.offset()};
  points_ = std::make_unique<EndPointsTable>(placer, tools_.team);
  memory_.take(points_->bytes(), "sample points of clusters");
  if (!refine_clusters(state_, tools_, brightness_, radiosity_, *points_, met, memory_, clusters_))
    return false;
  for (Task& task : tasks_) task.met = std::move(clusters_.met[static_cast<size_t>(task.root)]);
  return true;
}

// Large ones first: the last ones to end are small.
std::vector<size_t> RefiningRound::by_work() {
  std::vector<size_t> order;
  for (size_t k = 0; k < tasks_.size(); ++k) {
    Task& task = tasks_[k];
    const size_t root = static_cast<size_t>(task.root);
    task.work = (root < weight_.size() ? weight_[root] : 0) +
                static_cast<int64_t>(task.arriving.size() + task.met.size());
    // What is sealed takes many looks.
    const float exposed = state_.forest.nodes[root].exposed;
    if (exposed > 0 && exposed < 1) task.work *= work_of_partly_sealed;
    order.push_back(k);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return tasks_[a].work > tasks_[b].work; });
  return order;
}

// What a task is of its pass, and what it leaves to later ones: guesses.
double RefiningRound::work_of(const Task& task) {
  const double work = static_cast<double>(1 + task.work);
  return hands_on(task) ? work_of_handing_on * work : work;
}
double RefiningRound::left_by(const Task& task) {
  return hands_on(task) ? left_by_handing_on * static_cast<double>(task.work) : 0;
}

// Of the work of all tasks the share of those before each in the order, and of all.
std::vector<double> RefiningRound::work_in(const std::vector<size_t>& order) const {
  std::vector<double> until(1, 0.0);
  for (size_t k : order) until.push_back(until.back() + work_of(tasks_[k]));
  for (double& work : until) work /= until.back();
  return until;
}

// Of the round.
double RefiningRound::share_of_pass() const {
  double here = 0, left = 0;
  for (const Task& task : tasks_) {
    here += work_of(task);
    left += left_by(task);
  }
  return (1 - share_) * here / (here + left);
}

// False: stopped.
bool RefiningRound::pass() {
  state_.journal.next_pass();
  const std::vector<size_t> order = by_work();
  std::vector<SubtreeResult> results(tasks_.size());
  std::vector<std::unique_ptr<SubtreeRefiner>> refiners(tools_.team.size());
  for (auto& refiner : refiners)
    refiner =
        std::make_unique<SubtreeRefiner>(state_, tools_, brightness_, radiosity_, points_.get());
  std::vector<double> seconds(tasks_.size(), 0.0);
  std::vector<uint8_t> is_new(tasks_.size(), 0);
  const std::vector<double> work_until = work_in(order);
  const double covered = share_of_pass();
  const auto name_of = [&](size_t k) { return name_of_element(state_.forest, tasks_[k].root); };
  const bool going_on = state_.journal.for_each(
      tools_.team, static_cast<int64_t>(order.size()),
      [&](int64_t turn, int worker) {
        const size_t k = order[static_cast<size_t>(turn)];
        const Task& task = tasks_[k];
        is_new[k] = !state_.journal.known(name_of(k), [&](KnownResult& known) {
          return take_result(known, state_.forest, task.root, old_nodes_, results[k]);
        });
        if (is_new[k]) {
          const double start = thread_seconds();
          results[k] = refiners[worker]->refine(task.root, task.arriving, task.met, hands_on(task));
          seconds[k] = thread_seconds() - start;
        }
        memory_.take(bytes_of(results[k]), "refined links");
      },
      [&](int64_t done) {
        return tools_.progress(share_ + covered * work_until[static_cast<size_t>(done)]);
      },
      [&](LinkStep& step, int64_t turn) {
        const size_t k = order[static_cast<size_t>(turn)];
        if (is_new[k]) add_result(step, name_of(k), results[k]);
      });
  if (!going_on) return false;
  share_ += covered;
  for (size_t k = 0; k < tasks_.size(); ++k)
    work_[static_cast<size_t>(state_.forest.nodes[tasks_[k].root].surface)] += seconds[k];
  store(std::move(results));
  return true;
}

void RefiningRound::store(std::vector<SubtreeResult> results) {
  Pass pass;
  for (const Task& task : tasks_) pass.roots.push_back(task.root);
  pass.families.resize(results.size());
  tools_.team.for_each(static_cast<int64_t>(results.size()), [&](int64_t k, int) {
    pass.families[static_cast<size_t>(k)] = new_families(results[static_cast<size_t>(k)]);
  });
  pass.first = add_families(state_, pass.roots, pass.families, tools_.team, exchange_);
  state_.links.resize(state_.forest.nodes.size());
  std::vector<Task> next;
  for (size_t k = 0; k < results.size(); ++k) {
    SubtreeResult& result = results[k];
    if (!result.handed_on) continue;
    const NodeId child = state_.forest.nodes[pass.roots[k]].first_child;
    for (int32_t c = 0; c < 4; ++c) {
      SubtreeNode& node = result.nodes[static_cast<size_t>(result.nodes[0].first_child + c)];
      next.push_back({child + c, std::move(node.arriving), std::move(node.meeting)});
    }
  }
  pass.results = std::move(results);
  passes_.push_back(std::move(pass));
  tasks_ = std::move(next);
}

// The numbers that all elements have for all owners: pass by pass, in the order of all tasks.
void RefiningRound::number_anew() {
  drop_elements(state_, old_nodes_);
  std::vector<NodeId> roots;
  for (NodeId root = 0; root < state_.forest.surface_count(); ++root) roots.push_back(root);
  for (size_t p = 0; !roots.empty(); ++p) {
    const auto surface_of = [&](size_t k) { return state_.forest.nodes[roots[k]].surface; };
    std::vector<std::vector<NewFamily>> families(roots.size());
    std::vector<uint8_t> handed_on(roots.size(), 0);
    std::vector<size_t> own;
    for (size_t k = 0; k < roots.size(); ++k) {
      if (!exchange_.mine(surface_of(k))) continue;
      Pass& pass = passes_[p];
      families[k] = std::move(pass.families[own.size()]);
      handed_on[k] = pass.results[own.size()].handed_on;
      own.push_back(k);
    }
    exchange_.share_lists(families, surface_of);
    exchange_.share(handed_on, surface_of, tools_.team);
    const std::vector<NodeId> first = add_families(state_, roots, families, tools_.team, exchange_);
    for (size_t k = 0; k < own.size(); ++k) {
      passes_[p].roots[k] = roots[own[k]];
      passes_[p].first[k] = first[own[k]];
    }
    std::vector<NodeId> next;
    for (size_t k = 0; k < roots.size(); ++k)
      for (int32_t c = 0; c < 4 && handed_on[k]; ++c)
        next.push_back(state_.forest.nodes[roots[k]].first_child + c);
    roots = std::move(next);
  }
}

// Once all passes of all owners are known.
void RefiningRound::finish() {
  if (!exchange_.alone()) number_anew();
  for (const Pass& pass : passes_)
    for (size_t k = 0; k < pass.results.size(); ++k) {
      const SubtreeResult& result = pass.results[k];
      state_.rays += result.rays;
      const size_t kept = result.handed_on ? 1 : result.nodes.size();
      NodeId made = pass.first[k];
      for (size_t at = 0; at < kept; ++at) {
        const NodeId old = at == 0 ? pass.roots[k] : result.nodes[at].old_id;
        new_links_.push_back({old >= 0 ? old : made++, result.nodes[at].run});
      }
    }
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
  state_.links.resize(state_.forest.nodes.size());
  state_.links.replace(std::move(new_links_), &tools_.team);
  passes_.clear();
  pull_exposure(state_, tools_.team);
  measure_clusters(state_.forest);
  // What turned out to be sealed all over receives nothing.
  std::vector<LinkTable::NewRun> sealed;
  for (size_t k = 0; k < state_.forest.nodes.size(); ++k)
    if (state_.forest.nodes[k].exposed <= 0 && !state_.forest.is_leaf(static_cast<NodeId>(k)) &&
        state_.links[k].count() > 0)
      sealed.push_back({static_cast<NodeId>(k), {}});
  state_.links.replace(std::move(sealed), &tools_.team);
  tools_.exchange.ask_for_sources(state_, tools_.team);
  shrink_to_fit(state_);
  memory_.settle();
}

}  // namespace

bool link_clusters(State& state, const StageTools& tools, const Brightness& brightness) {
  const NodeId top = state.forest.top();
  const LightOfAll radiosity(state, &State::radiosity, tools.exchange, tools.team);
  RefiningRound round(state, tools, brightness, radiosity);
  return round.run({&top, 1});
}

bool refine_links(State& state, const StageTools& tools, const Brightness& brightness,
                  const LightOfAll& radiosity, std::vector<double>* work) {
  RefiningRound round(state, tools, brightness, radiosity);
  if (!round.run({})) return false;
  if (work) *work = round.work();
  return true;
}

}  // namespace hrad
