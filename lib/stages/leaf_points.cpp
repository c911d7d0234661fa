// Naming and settling. Floor 7 (stages).
#include "stages/leaf_points.h"

#include <algorithm>

#include "base/memory_budget.h"
#include "machine/pieces.h"

namespace hrad {

int64_t LeafPoints::bytes() const {
  return bytes_in(named_) + bytes_in(own_of_) + shares_.bytes() + owns_.bytes() +
         bytes_in(shared_) + bytes_in(own_);
}

void LeafPoints::resize(size_t nodes) { named_.resize(nodes, none); }

void LeafPoints::name_own(size_t leaf, int32_t first, const Places& places) {
  named_[leaf] = three_from(first);
  own_of_.push_back({leaf, {first, places}});
}

void LeafPoints::settle(ThreadTeam& team) {
  const auto is_forgotten = [&](const auto& own) { return named_[own.first][0] < 0; };
  own_of_.erase(std::remove_if(own_of_.begin(), own_of_.end(), is_forgotten), own_of_.end());
  std::sort(own_of_.begin(), own_of_.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  constexpr size_t of_a_word = Presence::of_a_word;
  const size_t nodes = named_.size(), words = pieces_of(nodes, of_a_word);
  std::vector<uint64_t> owns(words, 0), shares(words, 0);
  LeafPoints settled;
  settled.own_.reserve(own_of_.size());
  for (const auto& [leaf, own] : own_of_) {
    owns[leaf / of_a_word] |= uint64_t{1} << leaf % of_a_word;
    settled.own_.push_back(own);
  }
  for_each_thing(team, words, [&](size_t word) {
    uint64_t any = 0;
    for (size_t k = word * of_a_word; k < std::min(nodes, (word + 1) * of_a_word); ++k)
      any |= uint64_t{named_[k][0] >= 0} << k % of_a_word;
    shares[word] = any & ~owns[word];
  });
  settled.owns_ = Presence(nodes, std::move(owns));
  settled.shares_ = Presence(nodes, std::move(shares));
  settled.shared_.resize(settled.shares_.count());
  for_each_thing(team, nodes, [&](size_t leaf) {
    if (settled.shares_[leaf]) settled.shared_[settled.shares_.place(leaf)] = named_[leaf];
  });
  *this = std::move(settled);
}

void LeafPoints::renumber(const std::vector<int32_t>& number, ThreadTeam& team) {
  for_each_thing(team, shared_.size(), [&](size_t k) {
    for (int32_t& point : shared_[k]) point = number[static_cast<size_t>(point)];
  });
  for_each_thing(team, own_.size(),
                 [&](size_t k) { own_[k].first = number[static_cast<size_t>(own_[k].first)]; });
}

void LeafPoints::keep(const std::function<bool(size_t leaf)>& holds) {
  LeafPoints kept;
  for (size_t leaf = 0; leaf < size(); ++leaf) {
    const Places* own = own_places(leaf);
    if (!holds(leaf))
      kept.append(none);
    else if (own)
      kept.append_own((*this)[leaf][0], *own);
    else
      kept.append((*this)[leaf]);
  }
  kept.shrink_to_fit();
  *this = std::move(kept);
}

void LeafPoints::append(const Numbers& numbers) {
  const bool any = numbers[0] >= 0;
  shares_.push_back(any);
  owns_.push_back(false);
  if (any) shared_.push_back(numbers);
}

void LeafPoints::append_own(int32_t first, const Places& places) {
  shares_.push_back(false);
  owns_.push_back(true);
  own_.push_back({first, places});
}

void LeafPoints::shrink_to_fit() {
  shares_.shrink_to_fit();
  owns_.shrink_to_fit();
  shared_.shrink_to_fit();
  own_.shrink_to_fit();
}

}  // namespace hrad
