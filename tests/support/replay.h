// A recorded solve, laid out on nodes with so many threads each and a network between them: what
// its time would be there, and along the critical path what it is spent on. The schedule follows
// from the recording alone: tasks are taken in ascending order by the first free thread, stretches
// run on one, and ranks wait for each other where the solver makes them.
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <queue>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "support/timeline.h"

namespace hrad_test {

struct Machine {
  int threads = 1;
  double latency = 2e-6;     // seconds of a message
  double bandwidth = 1.6e9;  // bytes per second, into a node and out of it
  double wake = 0;           // seconds until sleeping threads have entered a loop
  bool cut_at_will = false;  // tasks are as small as one likes
};

// What a part of the critical path is spent on: a loop or an exchange at one site, or the stretch
// on one thread between two of them (-1: begin or end).
struct Part {
  Kind kind;
  int32_t from, to;
  bool operator<(const Part& o) const {
    return std::tie(kind, from, to) < std::tie(o.kind, o.from, o.to);
  }
};

struct Replayed {
  double seconds = 0;
  std::map<Part, double> critical;     // adds up to seconds
  std::map<int32_t, double> of_stage;  // likewise
};

// Seconds until the last of the tasks is done.
inline double loop_seconds(const std::vector<double>& tasks, int threads,
                           bool cut_at_will = false) {
  if (cut_at_will) return std::accumulate(tasks.begin(), tasks.end(), 0.0) / threads;
  std::priority_queue<double, std::vector<double>, std::greater<double>> free;
  for (int k = 0; k < threads; ++k) free.push(0);
  double last = 0;
  for (double task : tasks) {
    const double end = free.top() + task;
    free.pop();
    free.push(end);
    last = std::max(last, end);
  }
  return last;
}

class Replay {
 public:
  Replay(const std::vector<Timeline>& ranks, const Machine& machine)
      : ranks_(ranks),
        machine_(machine),
        next_(ranks.size(), 0),
        clock_(ranks.size(), 0.0),
        site_(ranks.size(), -1),
        since_(ranks.size()),
        start_(ranks.size(), 0.0),
        to_(ranks.size()) {}

  Replayed run() {
    for (;;) {
      for (size_t rank = 0; rank < ranks_.size(); ++rank) work(rank);
      if (next_[0] == ranks_[0].size()) break;
      together();
    }
    for (size_t rank = 0; rank < ranks_.size(); ++rank)
      if (next_[rank] != ranks_[rank].size()) unfit();
    meet();
    result_.seconds = clock_[0];
    return result_;
  }

 private:
  struct Step {
    Part part;
    int32_t stage;
    double seconds;
  };

  [[noreturn]] static void unfit() {
    throw std::runtime_error("ranks don't agree on what they tell each other");
  }

  void spend(size_t rank, const Event& event, Part part, double seconds) {
    clock_[rank] += seconds;
    since_[rank].push_back({part, event.stage, seconds});
  }

  // All that one rank does until it has to do with others.
  void work(size_t rank) {
    const Timeline& all = ranks_[rank];
    for (size_t& k = next_[rank]; k < all.size(); ++k) {
      const Event& event = all[k];
      if (event.kind == Kind::serial) {
        size_t end = k;
        while (end < all.size() && all[end].kind == Kind::serial) ++end;
        const int32_t to = end < all.size() ? all[end].site : -1;
        spend(rank, event, {Kind::serial, site_[rank], to}, event.seconds);
      } else if (event.kind == Kind::loop) {
        const bool shared = machine_.threads > 1 && event.tasks.size() > 1;
        site_[rank] = event.site;
        spend(rank, event, {Kind::loop, event.site, event.site},
              loop_seconds(event.tasks, machine_.threads, machine_.cut_at_will) +
                  (shared ? machine_.wake : 0));
      } else {
        return;
      }
    }
  }

  // The last rank to come decides: what it did since the last meeting is on the critical path.
  void meet() {
    size_t last = 0;
    for (size_t rank = 0; rank < clock_.size(); ++rank)
      if (clock_[rank] > clock_[last]) last = rank;
    for (const Step& step : since_[last]) {
      result_.critical[step.part] += step.seconds;
      result_.of_stage[step.stage] += step.seconds;
    }
    for (size_t rank = 0; rank < clock_.size(); ++rank) {
      since_[rank].clear();
      clock_[rank] = clock_[last];
    }
  }

  void together() {
    const Kind kind = ranks_[0][next_[0]].kind;
    std::vector<const Event*> events;
    for (size_t rank = 0; rank < ranks_.size(); ++rank) {
      if (next_[rank] == ranks_[rank].size()) unfit();
      events.push_back(&ranks_[rank][next_[rank]++]);
      if (events.back()->kind != kind) unfit();
    }
    if (kind == Kind::start_exchange)
      start(events);
    else if (kind == Kind::finish_exchange)
      finish(events);
    else
      all_at_once(kind, events);
    for (size_t rank = 0; rank < ranks_.size(); ++rank) site_[rank] = events[rank]->site;
  }

  // Sending costs the rank nothing: messages travel by themselves.
  void start(const std::vector<const Event*>& events) {
    start_ = clock_;
    for (size_t rank = 0; rank < ranks_.size(); ++rank) to_[rank] = events[rank]->bytes;
  }

  // A node sends its messages in the order of ranks, one after the other, and receives at the same
  // rate.
  void finish(const std::vector<const Event*>& events) {
    const size_t count = ranks_.size();
    std::vector<double> arrived(count, 0), first(count, 1e300), into(count, 0);
    for (size_t from = 0; from < count; ++from) {
      double sent = 0;
      for (size_t to = 0; to < count; ++to) {
        const double bytes = from == to ? 0 : static_cast<double>(to_[from][to]);
        if (!(bytes > 0)) continue;
        sent += bytes / machine_.bandwidth;
        into[to] += bytes / machine_.bandwidth;
        first[to] = std::min(first[to], start_[from]);
        arrived[to] = std::max(arrived[to], start_[from] + machine_.latency + sent);
      }
    }
    for (size_t rank = 0; rank < count; ++rank) {
      if (into[rank] > 0)
        arrived[rank] = std::max(arrived[rank], first[rank] + machine_.latency + into[rank]);
      spend(rank, *events[rank], {Kind::finish_exchange, events[rank]->site, events[rank]->site},
            std::max(0.0, arrived[rank] - clock_[rank]));
    }
  }

  // Along a tree of ranks; bytes at the rate at which a node receives them.
  void all_at_once(Kind kind, const std::vector<const Event*>& events) {
    meet();
    double bytes = 0;
    for (size_t rank = 0; rank < events.size(); ++rank) {
      const double own =
          events[rank]->bytes.empty() ? 0.0 : static_cast<double>(events[rank]->bytes[0]);
      bytes = kind == Kind::gather_all ? bytes + own : std::max(bytes, own);
    }
    // A rank receives what all others give; the smallest gift says who receives most.
    if (kind == Kind::gather_all) {
      double least = bytes;
      for (const Event* event : events)
        least = std::min(least, static_cast<double>(event->bytes[0]));
      bytes -= least;
    }
    const double steps = std::ceil(std::log2(static_cast<double>(ranks_.size())));
    const double seconds =
        ranks_.size() == 1 ? 0 : machine_.latency * steps + bytes / machine_.bandwidth;
    for (size_t rank = 0; rank < ranks_.size(); ++rank)
      spend(rank, *events[rank], {kind, events[rank]->site, events[rank]->site}, seconds);
  }

  const std::vector<Timeline>& ranks_;
  const Machine machine_;
  std::vector<size_t> next_;
  std::vector<double> clock_;
  std::vector<int32_t> site_;  // of the last loop or exchange
  std::vector<std::vector<Step>> since_;
  std::vector<double> start_;             // of the exchange under way
  std::vector<std::vector<int64_t>> to_;  // likewise
  Replayed result_;
};

inline Replayed replay(const std::vector<Timeline>& ranks, const Machine& machine) {
  return Replay(ranks, machine).run();
}

}  // namespace hrad_test
