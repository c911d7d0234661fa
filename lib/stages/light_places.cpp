// Places are given in the order of asking. Floor 7 (stages).
#include "stages/light_places.h"

namespace hrad {

// Roots and clusters keep their numbers as places, all elements before them none.
void LightPlaces::keep_some(size_t first_element) {
  of_some_ = true;
  first_element_ = nodes_ = count_ = end_of_own_ = first_element;
  shift_ = static_cast<uint32_t>((4 - first_element % 4) % 4);
  first_.resize_for_overwrite((first_element + shift_) / 4);
  for (size_t k = 0; k < first_.size(); ++k)
    first_[k] = static_cast<int32_t>(4 * k) - static_cast<int32_t>(shift_);
}

void LightPlaces::resize(size_t nodes) {
  if (of_some_) {
    const size_t before = first_.size(), groups = (nodes + shift_) / 4;
    for (size_t k = groups; k < before; ++k)
      if (first_[k] != none) count_ = std::min(count_, static_cast<size_t>(first_[k]));
    end_of_own_ = std::min(end_of_own_, count_);
    first_.resize_for_overwrite(groups);
    for (size_t k = before; k < groups; ++k) first_[k] = none;
  }
  nodes_ = nodes;
}

void LightPlaces::add_family(NodeId first) {
  int32_t& place = first_[group(shift_, first)];
  if (place != none) return;
  place = static_cast<int32_t>(count_);
  count_ += 4;
}

}  // namespace hrad
