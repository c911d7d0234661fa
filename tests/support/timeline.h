// What each rank of a solve did, one thing after the other: stretches on one thread, loops with the
// seconds of every task, and what was told to other ranks. replay.h lays it out on any number of
// threads, recorder.h makes it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace hrad_test {

enum class Kind : uint8_t {
  serial,
  loop,
  tell,  // the agreement before every exchange
  broadcast,
  gather_all,
  start_exchange,
  finish_exchange,
  add_up
};

struct Event {
  Kind kind = Kind::serial;
  int32_t stage = 0;           // into Recording::stages
  int32_t site = -1;           // where it was called, into Recording::sites; none of a stretch
  double seconds = 0;          // of a stretch
  std::vector<double> tasks;   // of a loop: seconds of each
  std::vector<int64_t> bytes;  // of start_exchange: to every rank; else what this rank gives
};

using Timeline = std::vector<Event>;

struct Recording {
  std::vector<Timeline> ranks;
  std::vector<std::string> stages;
  std::vector<std::vector<void*>> sites;  // calling addresses, innermost first

  int32_t stage_number(const std::string& name) {
    const auto at = std::find(stages.begin(), stages.end(), name);
    if (at == stages.end()) return stages.push_back(name), static_cast<int32_t>(stages.size()) - 1;
    return static_cast<int32_t>(at - stages.begin());
  }
  int32_t site_number(const std::vector<void*>& stack) {
    const auto at = std::find(sites.begin(), sites.end(), stack);
    if (at == sites.end()) return sites.push_back(stack), static_cast<int32_t>(sites.size()) - 1;
    return static_cast<int32_t>(at - sites.begin());
  }
};

// The events of some stages. All ranks drop the same ones, so that what they tell each other still
// fits together.
inline std::vector<Timeline> events_of(const Recording& recording,
                                       const std::function<bool(const std::string&)>& wanted) {
  std::vector<Timeline> ranks;
  for (const Timeline& all : recording.ranks) {
    ranks.emplace_back();
    for (const Event& event : all)
      if (wanted(recording.stages[static_cast<size_t>(event.stage)])) ranks.back().push_back(event);
  }
  return ranks;
}

// Another recording of the same solve: of each cost the lesser is the less disturbed one.
inline void keep_the_least(Recording& kept, const Recording& other) {
  const auto least = [](double& a, double b) { a = std::min(a, b); };
  const auto unlike = [](bool same) {
    if (!same) throw std::runtime_error("two solves of one scene went different ways");
  };
  unlike(kept.ranks.size() == other.ranks.size());
  for (size_t rank = 0; rank < kept.ranks.size(); ++rank) {
    unlike(kept.ranks[rank].size() == other.ranks[rank].size());
    for (size_t k = 0; k < kept.ranks[rank].size(); ++k) {
      Event& event = kept.ranks[rank][k];
      const Event& again = other.ranks[rank][k];
      unlike(event.kind == again.kind && event.tasks.size() == again.tasks.size());
      least(event.seconds, again.seconds);
      for (size_t t = 0; t < event.tasks.size(); ++t) least(event.tasks[t], again.tasks[t]);
    }
  }
}

}  // namespace hrad_test
