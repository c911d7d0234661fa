// Recording, and finding again. Floor 7 (stages).
#include "stages/link_journal.h"

#include <algorithm>
#include <chrono>
#include <cstring>

#include "base/hash.h"

namespace hrad {
namespace {

// What a process that dies may lose of a stage, and for how long threads don't wait for each other.
constexpr double seconds_of_a_turn = 2;
// What is written as one piece.
constexpr size_t longest_step = size_t{64} << 20;  // bytes

int64_t bytes_of(const LinkStep& step) {
  return static_cast<int64_t>((step.names.capacity() + step.ends.capacity()) * sizeof(uint64_t) +
                              step.results.capacity());
}

}  // namespace

void LinkJournal::begin(uint64_t key, int64_t rays, int64_t pairs) {
  // Results are kept as they lie in memory: a machine of another byte order has its own.
  const uint32_t one = 1;
  uint8_t first_byte;
  std::memcpy(&first_byte, &one, 1);
  key = mix(key, first_byte);
  if (key != key_) clear();
  key_ = key;
  rays_before = rays;
  pairs_before = pairs;
  pass_ = 0;
  known_.clear();
}

void LinkJournal::next_pass() {
  ++pass_;
  known_.clear();
  for (size_t step = 0; step < steps_.size(); ++step)
    for (size_t task = 0; task < steps_[step].names.size() && steps_[step].pass == pass_; ++task)
      known_.push_back({steps_[step].names[task], step, task});
  std::sort(known_.begin(), known_.end(), [](const Entry& a, const Entry& b) {
    return a.name != b.name ? a.name < b.name : a.step < b.step;
  });
}

bool LinkJournal::known(uint64_t name, const std::function<bool(KnownResult&)>& use) const {
  auto entry = std::lower_bound(known_.begin(), known_.end(), name,
                                [](const Entry& e, uint64_t n) { return e.name < n; });
  for (; entry != known_.end() && entry->name == name; ++entry) {
    const LinkStep& step = steps_[entry->step];
    const uint64_t first = entry->task > 0 ? step.ends[entry->task - 1] : 0;
    KnownResult result(step.results.data() + first, step.ends[entry->task] - first);
    if (use(result)) return true;
  }
  return false;
}

bool LinkJournal::known_run(uint64_t name, const std::function<bool(NodeId)>& is_source,
                            std::vector<Link>& links, int64_t& rays) const {
  return !known_.empty() && known(name, [&](KnownResult& result) {
    std::vector<Link> run;
    int64_t rays_of_run = 0;
    if (!result.take(&rays_of_run, 1) || !is_count(rays_of_run) || !result.take_list(run) ||
        !result.at_end() || !are_links(run, is_source))
      return false;
    links.insert(links.end(), run.begin(), run.end());
    rays = rays_of_run;
    return true;
  });
}

bool LinkJournal::for_each(ThreadTeam& team, int64_t count,
                           const std::function<void(int64_t task, int worker)>& body,
                           const std::function<bool(int64_t done)>& between,
                           const std::function<void(LinkStep& step, int64_t task)>& add) {
  if (!recording) return team.for_each(count, body, between);
  using Clock = std::chrono::steady_clock;
  std::vector<uint8_t> is_done(static_cast<size_t>(count), 0);
  bool going_on = true;
  for (int64_t next = 0; next < count && going_on;) {
    const Clock::time_point start = Clock::now();
    const int64_t first = next;
    team.for_each(
        count - first,
        [&](int64_t turn, int worker) {
          body(first + turn, worker);
          is_done[static_cast<size_t>(first + turn)] = 1;
        },
        [&](int64_t done) {
          going_on = going_on && between(first + done);
          return going_on &&
                 std::chrono::duration<double>(Clock::now() - start).count() < seconds_of_a_turn;
        });
    // Tasks begin in ascending order, and those that were begun have been finished.
    LinkStep step;
    for (; next < count && is_done[static_cast<size_t>(next)]; ++next) {
      add(step, next);
      if (step.results.size() < longest_step) continue;
      record(std::move(step));
      step = LinkStep{};
    }
    record(std::move(step));
  }
  return going_on;
}

bool LinkJournal::next_pass_of(ThreadTeam& team, size_t count, const Results& results,
                               const std::function<bool(int64_t done)>& between) {
  next_pass();
  std::vector<uint8_t> is_new(count, 0);
  return for_each(
      team, static_cast<int64_t>(count),
      [&](int64_t task, int worker) {
        const size_t k = static_cast<size_t>(task);
        is_new[k] = known_.empty() || !known(results.name(k), [&](KnownResult& known) {
                      return results.take(k, known);
                    });
        if (is_new[k]) results.make(k, worker);
      },
      between,
      [&](LinkStep& step, int64_t task) {
        const size_t k = static_cast<size_t>(task);
        if (!is_new[k]) return;
        results.put(k, step.results);
        step.end_task(results.name(k));
      });
}

void LinkJournal::record(LinkStep step) {
  if (step.names.empty()) return;
  step.pass = pass_;
  push(std::move(step));
}

void LinkJournal::push(LinkStep step) {
  bytes_ += bytes_of(step);
  steps_.push_back(std::move(step));
}

LinkJournal LinkJournal::restored(uint64_t key, int64_t rays_before, int64_t pairs_before,
                                  std::vector<LinkStep> steps) {
  LinkJournal journal;
  journal.key_ = key;
  journal.rays_before = rays_before;
  journal.pairs_before = pairs_before;
  for (LinkStep& step : steps) journal.push(std::move(step));
  journal.restored_steps_ = journal.steps_.size();
  return journal;
}

bool are_links(const std::vector<Link>& links, const std::function<bool(NodeId)>& is_source) {
  return std::all_of(links.begin(), links.end(), [&](const Link& link) {
    return link.weight >= 0 && link.weight <= largest_weight && is_source(link.source);
  });
}

}  // namespace hrad
