// All pairs, cut into tasks; reciprocals to the owners of their receivers; the table of links.
// Floor 7 (stages).
#include "stages/linking.h"

#include <algorithm>
#include <initializer_list>
#include <utility>
#include <vector>

#include "stages/exchange.h"
#include "stages/pair_linker.h"
#include "stages/pair_record.h"
#include "stages/remote_links.h"
#include "stages/state_memory.h"

namespace hrad {
namespace {

// What is found is put together after so many, so that little stands beside it.
constexpr size_t tasks_of_a_batch = 65536;

// Every process counts those of its own surfaces with later ones, per pair of owners.
std::vector<uint64_t> facing_pairs(const PairLinker& linker, int64_t count,
                                   const StageTools& tools) {
  const Exchange& exchange = tools.exchange;
  const size_t owners = static_cast<size_t>(exchange.owner_count());
  std::vector<std::vector<uint64_t>> of_worker(static_cast<size_t>(tools.team.size()),
                                               std::vector<uint64_t>(owners * owners, 0));
  tools.team.for_each(count, [&](int64_t p, int worker) {
    if (!exchange.mine(static_cast<int32_t>(p))) return;
    const size_t first = static_cast<size_t>(p) + 1;
    std::vector<uint8_t> faces(static_cast<size_t>(count) - first);
    linker.facing().find(static_cast<size_t>(p), first, faces.size(), faces.data());
    uint64_t* const row =
        &of_worker[static_cast<size_t>(worker)]
                  [static_cast<size_t>(exchange.owner(static_cast<int32_t>(p))) * owners];
    for (size_t k = 0; k < faces.size(); ++k)
      row[exchange.owner(static_cast<int32_t>(first + k))] += faces[k];
  });
  std::vector<uint64_t> sum(owners * owners, 0);
  for (const auto& counts : of_worker)
    for (size_t k = 0; k < sum.size(); ++k) sum[k] += counts[k];
  exchange.comm().add_up({sum.data(), sum.size()});
  return sum;
}

// Pairs of one owner's surfaces, or of two owners'.
enum class Which { of_one_owner, of_two_owners };

// What is found, and by whom what is looked for.
class PairSearch {
 public:
  PairSearch(State& state, const StageTools& tools, const Brightness& brightness)
      : state_(state),
        tools_(tools),
        exchange_(tools.exchange),
        count_(state.forest.surface_count()),
        linker_(state, tools, brightness),
        remote_(exchange_.owner_count(), exchange_.alone() ? std::vector<uint64_t>{0}
                                                           : facing_pairs(linker_, count_, tools)),
        found_(static_cast<size_t>(count_)) {
    state.journal.next_pass();
  }

  // False: stopped.
  bool look_at(Which which, StageMemory& memory) {
    const std::vector<PairTask> tasks = tasks_of(which);
    const LinkSampler model(state_.forest, tools_.engine, tools_.exposure, tools_.oracle.seed,
                            tools_.oracle.near_ratio);
    std::vector<LinkSampler> samplers(tools_.team.size(), model);
    bool going_on = true;
    for (size_t first = 0; first < tasks.size() && going_on; first += tasks_of_a_batch)
      going_on = look_at_some(tasks, first, which, samplers, memory);
    return exchange_.all_go_on(going_on);
  }

  // To every owner the links of its receivers that were found here.
  std::vector<Bytes> for_others() const {
    std::vector<Bytes> to(static_cast<size_t>(exchange_.owner_count()));
    for (size_t k = 0; k < found_.size(); ++k) {
      const NodeId p = static_cast<NodeId>(k);
      for (const Reciprocal& r : found_[k]) {
        const FoundLink links[2] = {{p, {r.other, r.to_this}}, {r.other, {p, r.to_other}}};
        for (const FoundLink& link : links)
          if (!exchange_.mine(link.receiver)) put(to[exchange_.owner(link.receiver)], &link, 1);
      }
    }
    return to;
  }

  // Sorts the found links to their receivers: for each the sources in ascending order.
  LinkTable collect(const std::vector<Bytes>& from_others);

  int64_t bytes_found() const {
    size_t links = 0;
    for (const auto& found : found_) links += found.size();
    return static_cast<int64_t>(links * sizeof(Reciprocal));
  }

 private:
  // Whether this process is to look at pairs of p with surfaces of that owner.
  bool is_mine(NodeId p, int32_t other, Which which) const {
    const int32_t owner = exchange_.owner(p);
    return (owner == other) == (which == Which::of_one_owner) &&
           exchange_.is_me(remote_.computed_by(owner, other));
  }

  std::vector<PairTask> tasks_of(Which which) const {
    std::vector<PairTask> tasks;
    for (NodeId p = 0; p < static_cast<NodeId>(count_); ++p) {
      bool any = false;
      for (int32_t other = 0; other < exchange_.owner_count(); ++other)
        any = any || is_mine(p, other, which);
      if (!any) continue;
      for (NodeId first = p + 1; first < static_cast<NodeId>(count_); first += partners_of_a_task)
        tasks.push_back(
            {p, first, std::min(static_cast<NodeId>(count_), first + partners_of_a_task)});
    }
    return tasks;
  }

  // The tasks from `first` on, so many as make a batch.
  bool look_at_some(const std::vector<PairTask>& tasks, size_t first, Which which,
                    std::vector<LinkSampler>& samplers, StageMemory& memory) {
    const size_t count = std::min(tasks_of_a_batch, tasks.size() - first);
    std::vector<PairsFound> known(count), results(count);
    const bool going_on = state_.journal.for_each(
        tools_.team, static_cast<int64_t>(count),
        [&](int64_t turn, int worker) {
          const size_t k = static_cast<size_t>(turn);
          const PairTask& task = tasks[first + k];
          const auto wanted = [&](NodeId q) { return is_mine(task.p, exchange_.owner(q), which); };
          known[k] = known_pairs(state_.journal, task, wanted);
          results[k] = linker_.link(task, wanted, known[k].looked_at, samplers[worker]);
          memory.take(static_cast<int64_t>((known[k].found.size() + results[k].found.size()) *
                                           sizeof(Reciprocal)),
                      "links");
        },
        [&](int64_t done) {
          return tools_.progress((static_cast<double>(first) + static_cast<double>(done)) /
                                 static_cast<double>(tasks.size()));
        },
        [&](LinkStep& step, int64_t turn) {
          const size_t k = static_cast<size_t>(turn);
          if (results[k].looked_at.any()) add_result(step, tasks[first + k], results[k]);
        });
    for (size_t k = 0; k < count && going_on; ++k) take(tasks[first + k], {&known[k], &results[k]});
    return going_on;
  }

  void take(const PairTask& task, std::initializer_list<const PairsFound*> results) {
    auto& found = found_[static_cast<size_t>(task.p)];
    const auto before = static_cast<std::ptrdiff_t>(found.size());
    for (const PairsFound* result : results) {
      state_.rays += result->rays;
      state_.pairs += result->pairs;
      found.insert(found.end(), result->found.begin(), result->found.end());
    }
    std::sort(found.begin() + before, found.end(),
              [](const Reciprocal& a, const Reciprocal& b) { return a.other < b.other; });
  }

  State& state_;
  const StageTools& tools_;
  const Exchange& exchange_;
  const int64_t count_;
  const PairLinker linker_;
  const RemoteLinks remote_;
  std::vector<std::vector<Reciprocal>> found_;  // per surface, with later ones only
};

LinkTable PairSearch::collect(const std::vector<Bytes>& from_others) {
  std::vector<std::vector<Link>> runs(found_.size());
  for (const Bytes& bytes : from_others) {
    Taker taker(bytes);
    for (size_t k = 0; k < bytes.size() / sizeof(FoundLink); ++k) {
      FoundLink found;
      taker.take(&found, 1);
      runs[static_cast<size_t>(found.receiver)].push_back(found.link);
    }
  }
  std::vector<int32_t> counts(found_.size(), 0);
  for (const auto& list : found_)
    for (const Reciprocal& r : list) ++counts[r.other];
  LinkTable table;
  for (size_t k = 0; k < found_.size(); ++k)
    runs[k].reserve(runs[k].size() + static_cast<size_t>(counts[k]) + found_[k].size());
  for (size_t p = 0; p < found_.size(); ++p) {
    // All surfaces before p have added theirs to runs[p] by now.
    for (const Reciprocal& r : found_[p]) {
      if (exchange_.mine(static_cast<int32_t>(p))) runs[p].push_back({r.other, r.to_this});
      if (exchange_.mine(r.other)) runs[r.other].push_back({static_cast<NodeId>(p), r.to_other});
    }
    if (!exchange_.alone())
      std::sort(runs[p].begin(), runs[p].end(),
                [](const Link& a, const Link& b) { return a.source < b.source; });
    table.append(runs[p]);
    std::vector<Link>().swap(runs[p]);
    std::vector<Reciprocal>().swap(found_[p]);
  }
  table.shrink_to_fit();
  return table;
}

}  // namespace

bool link_pairs(State& state, const StageTools& tools, const Brightness& brightness) {
  PairSearch search(state, tools, brightness);
  StageMemory memory(state);
  Comm& comm = tools.exchange.comm();
  // Links that others wait for come first, and travel while own ones are looked at.
  if (!comm.alone()) {
    if (!search.look_at(Which::of_two_owners, memory)) return false;
    comm.start_exchange(search.for_others());
  }
  const bool done = search.look_at(Which::of_one_owner, memory);
  std::vector<Bytes> from_others;
  if (!comm.alone()) from_others = comm.finish_exchange();
  if (!done) return false;
  memory.take(2 * search.bytes_found(), "links");  // each in both directions, in two places a while
  state.links = search.collect(from_others);
  tools.exchange.ask_for_sources(state, tools.team);
  memory.settle();
  return true;
}

}  // namespace hrad
