// What a task of linking by pairs has looked at and found, as a result in the journal and back.
// Which pairs of a stretch a process looks at is another matter for other processes, so each is
// known by itself. Floor 7 (stages).
#pragma once

#include <bitset>
#include <functional>
#include <vector>

#include "stages/link_journal.h"

namespace hrad {

// A pair of which the lower-numbered surface took care: weights in both directions.
struct Reciprocal {
  NodeId other;
  float to_this, to_other;
};

// Surface p with first .. end-1, all later ones.
constexpr NodeId partners_of_a_task = 512;
struct PairTask {
  NodeId p, first, end;
};
using Partners = std::bitset<partners_of_a_task>;  // by their place in the stretch

struct PairsFound {
  Partners looked_at;
  std::vector<Reciprocal> found;  // in the order of the other surfaces
  int64_t rays = 0, pairs = 0;
};

// The results of all who looked at wanted pairs of the task; what they counted is handed to the one
// who wants the first pair that they looked at.
PairsFound known_pairs(const LinkJournal& journal, const PairTask& task,
                       const std::function<bool(NodeId)>& wanted);
void add_result(LinkStep& step, const PairTask& task, const PairsFound& result);

}  // namespace hrad
