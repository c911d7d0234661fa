// The points of all owners, numbered as one process alone would number them. Floor 8 (solver).
#pragma once

#include <cstdint>
#include <vector>

#include "stages/exchange.h"
#include "stages/state.h"

namespace hrad {

// Things of all owners in one order, of which each process has some, in this order too.
class Places {
 public:
  Places() = default;
  // One process has them all.
  explicit Places(size_t count) : count_(static_cast<int64_t>(count)) {}
  void add(int32_t owner, bool mine) {
    if (mine) own_.push_back(count_);
    owner_.push_back(owner);
    ++count_;
  }
  int64_t count() const { return count_; }
  int32_t owner(int64_t place) const {
    return owner_.empty() ? 0 : owner_[static_cast<size_t>(place)];
  }
  // The place of the k-th own one, and which own one is at a place.
  int64_t place(size_t k) const { return owner_.empty() ? static_cast<int64_t>(k) : own_[k]; }
  size_t own(int64_t place) const;

 private:
  int64_t count_ = 0;
  std::vector<int32_t> owner_;  // empty: one process
  std::vector<int64_t> own_;
};

// The points at which direct light is known, in the order in which the leaves name them. What they
// are, and their links, stays with their owners.
class AllPoints {
 public:
  // Collective. Node::light_points of all elements are those of their owners from then on.
  AllPoints(State& state, const Exchange& exchange);

  const Places& points() const { return points_; }
  const Places& own_points() const { return own_points_; }  // three of each leaf that has some
  // Numbers instead of the own process's.
  LeafPoints::Numbers of_leaf(const CornerLight& direct, int64_t leaf) const;

 private:
  Places points_, own_points_;
};

}  // namespace hrad
