// Results of several, put together. Floor 7 (stages).
#include "stages/pair_record.h"

#include <algorithm>
#include <array>

namespace hrad {
namespace {

constexpr size_t bits_of_a_word = 64;
using Words = std::array<uint64_t, partners_of_a_task / bits_of_a_word>;

uint64_t name_of(const PairTask& task) {
  return static_cast<uint64_t>(task.p) << 32 | static_cast<uint32_t>(task.first);
}

bool is_weight(float weight) { return weight >= 0 && weight <= 1; }

bool take_result(KnownResult& known, const PairTask& task, PairsFound& result) {
  Words words;
  if (!known.take(&result.rays, 1) || !known.take(&result.pairs, 1) ||
      !known.take(words.data(), words.size()) || !known.take_list(result.found) ||
      !known.at_end() || !is_count(result.rays) || !is_count(result.pairs))
    return false;
  for (size_t k = 0; k < result.looked_at.size(); ++k)
    result.looked_at[k] = (words[k / bits_of_a_word] >> k % bits_of_a_word & 1) != 0;
  NodeId before = task.first - 1;
  return std::all_of(result.found.begin(), result.found.end(), [&](const Reciprocal& r) {
    const bool ascends = r.other > before && r.other < task.end;
    before = r.other;
    return ascends && result.looked_at[static_cast<size_t>(r.other - task.first)] &&
           is_weight(r.to_this) && is_weight(r.to_other);
  });
}

}  // namespace

PairsFound known_pairs(const LinkJournal& journal, const PairTask& task,
                       const std::function<bool(NodeId)>& wanted) {
  PairsFound all;
  Partners mine;
  journal.known(name_of(task), [&](KnownResult& known) {
    PairsFound result;
    if (!take_result(known, task, result) || (result.looked_at & all.looked_at).any()) return false;
    const auto stretch = static_cast<size_t>(task.end - task.first);
    bool is_first = true;
    for (size_t k = 0; k < stretch; ++k) {
      if (!result.looked_at[k]) continue;
      mine[k] = wanted(task.first + static_cast<NodeId>(k));
      if (is_first && mine[k]) {
        all.rays += result.rays;
        all.pairs += result.pairs;
      }
      is_first = false;
    }
    all.looked_at |= result.looked_at;
    for (const Reciprocal& r : result.found)
      if (mine[static_cast<size_t>(r.other - task.first)]) all.found.push_back(r);
    return false;  // another one may be of other partners
  });
  std::sort(all.found.begin(), all.found.end(),
            [](const Reciprocal& a, const Reciprocal& b) { return a.other < b.other; });
  return all;
}

void add_result(LinkStep& step, const PairTask& task, const PairsFound& result) {
  Words words = {};
  for (size_t k = 0; k < result.looked_at.size(); ++k)
    words[k / bits_of_a_word] |= static_cast<uint64_t>(result.looked_at[k]) << k % bits_of_a_word;
  put(step.results, &result.rays, 1);
  put(step.results, &result.pairs, 1);
  put(step.results, words.data(), words.size());
  put_list(step.results, result.found);
  step.end_task(name_of(task));
}

}  // namespace hrad
