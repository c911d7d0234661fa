// The points of leaves at which direct light is known (linking=rows): few leaves have any before
// they are named, and most share theirs with neighbours. Floor 7 (stages).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "base/presence.h"
#include "hierarchy/forest.h"

namespace hrad {

class ThreadTeam;

class LeafPoints {
 public:
  using Numbers = std::array<int32_t, 3>;  // in the order of Forest::triangle
  static constexpr Numbers none = {-1, -1, -1};
  // A place in a leaf, measured as element_coordinates() does.
  struct Place {
    float x, y;
  };
  using Places = std::array<Place, 3>;

  bool empty() const { return size() == 0; }
  size_t size() const { return named_.empty() ? shares_.size() : named_.size(); }  // nodes
  // None where a node has no direct light or is no leaf.
  Numbers operator[](size_t node) const {
    if (!named_.empty()) return named_[node];
    if (shares_[node]) return shared_[shares_.place(node)];
    return owns_[node] ? three_from(own_[owns_.place(node)].first) : none;
  }
  // Where the points lie that belong to this leaf alone; nullptr: it has none. Of settled ones.
  const Places* own_places(size_t node) const {
    return named_.empty() && owns_[node] ? &own_[owns_.place(node)].place : nullptr;
  }
  // The same, counted through all leaves that have such points.
  size_t own_count() const { return own_.size(); }
  int32_t first_own(size_t k) const { return own_[k].first; }
  Places& own(size_t k) { return own_[k].place; }
  const Places& own(size_t k) const { return own_[k].place; }
  int64_t bytes() const;

  // Naming, in any order; different leaves by different threads, but for name_own().
  void resize(size_t nodes);
  void name(size_t leaf, const Numbers& numbers) { named_[leaf] = numbers; }
  // Points of its own, numbered from `first` on.
  void name_own(size_t leaf, int32_t first, const Places& places);
  void forget(size_t leaf) { named_[leaf] = none; }
  // All are named: less room, and places can be looked up.
  void settle(ThreadTeam& team);

  // Of settled ones. number: the new one of each point that is named.
  void renumber(const std::vector<int32_t>& number, ThreadTeam& team);
  // Leaves for which this doesn't hold have none any more.
  void keep(const std::function<bool(size_t leaf)>& holds);

  // Naming in the order of the nodes, each once; settled all along. reserve(): room for so many
  // that share points.
  void reserve(size_t leaves) { shared_.reserve(leaves); }
  void append(const Numbers& numbers);  // none: it has none
  void append_own(int32_t first, const Places& places);
  void shrink_to_fit();

 private:
  struct Own {
    int32_t first;
    Places place;
  };
  static Numbers three_from(int32_t first) { return {first, first + 1, first + 2}; }

  std::vector<Numbers> named_;                  // per node, before they are settled
  std::vector<std::pair<size_t, Own>> own_of_;  // likewise, some of them forgotten since
  Presence shares_, owns_;                      // per node
  std::vector<Numbers> shared_;
  std::vector<Own> own_;
};

}  // namespace hrad
