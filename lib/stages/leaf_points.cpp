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

void LeafPoints::settle() {
  const auto is_forgotten = [&](const auto& own) { return named_[own.first][0] < 0; };
  own_of_.erase(std::remove_if(own_of_.begin(), own_of_.end(), is_forgotten), own_of_.end());
  std::sort(own_of_.begin(), own_of_.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  const auto named = std::count_if(named_.begin(), named_.end(),
                                   [](const Numbers& numbers) { return numbers[0] >= 0; });
  LeafPoints settled;
  settled.own_.reserve(own_of_.size());
  settled.shared_.reserve(static_cast<size_t>(named) - own_of_.size());
  auto own = own_of_.begin();
  for (size_t leaf = 0; leaf < named_.size(); ++leaf)
    if (own != own_of_.end() && own->first == leaf) {
      settled.append_own(own->second.first, own->second.place);
      ++own;
    } else {
      settled.append(named_[leaf]);
    }
  settled.shrink_to_fit();
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
