// Where a process keeps the light of a node: it has that of its own elements, of those that it has
// asked for, and of all roots and clusters. Floor 7 (stages).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/growing_array.h"
#include "hierarchy/node.h"

namespace hrad {

class LightPlaces {
 public:
  // To begin with every node has a place, in the order of their numbers: a process is alone.
  bool of_all() const { return !of_some_; }
  // From now on roots and clusters, all before the first element, and what is added.
  void keep_some(size_t first_element);
  size_t first_element() const { return first_element_; }

  size_t nodes() const { return nodes_; }
  size_t count() const { return of_some_ ? count_ : nodes_; }  // of places
  // Those from this one on are of elements that belong to others, whose radiosity alone matters.
  size_t end_of_own() const { return of_some_ ? end_of_own_ : nodes_; }
  // So many nodes: new ones have no place yet, and those behind lose theirs, to whom the last
  // places belong.
  void resize(size_t nodes);
  // A place for an element and its three brothers, whose first this is, side by side.
  void add_family(NodeId first);
  void add_own_family(NodeId first) {
    add_family(first);
    end_of_own_ = count_;
  }

  // Where a node has its light, if it has a place.
  size_t operator[](NodeId id) const {
    return of_some_ ? at(first_.data(), shift_, id) : static_cast<size_t>(id);
  }
  bool has(NodeId id) const { return !of_some_ || first_[group(shift_, id)] != none; }
  // body(node, place, count) for nodes begin .. end-1 that have places, stretch by stretch, of
  // which none is empty.
  template <class Body>
  void for_each_stretch(size_t begin, size_t end, const Body& body) const {
    if (begin == end) return;
    if (!of_some_) return body(begin, begin, end - begin);
    for (size_t id = begin, next; id < end; id = next) {
      const size_t number = group(shift_, static_cast<NodeId>(id));
      next = std::min(end, 4 * (number + 1) - shift_);
      if (first_[number] != none) body(id, (*this)[static_cast<NodeId>(id)], next - id);
    }
  }

  // The same for loops that look up one node after the other.
  class OfAll {
   public:
    size_t operator[](NodeId id) const { return static_cast<size_t>(id); }
  };
  class OfSome {
   public:
    explicit OfSome(const LightPlaces& places)
        : first_(places.first_.data()), shift_(places.shift_) {}
    size_t operator[](NodeId id) const { return at(first_, shift_, id); }

   private:
    const int32_t* first_;
    uint32_t shift_;
  };

  int64_t bytes() const { return bytes_in(first_); }
  void shrink_to_fit() { first_.shrink_to_fit(); }

 private:
  static constexpr int32_t none = -4;

  // Nodes are taken four at a time, shifted so that families are.
  static size_t group(uint32_t shift, NodeId id) { return (static_cast<uint32_t>(id) + shift) / 4; }
  static size_t at(const int32_t* first, uint32_t shift, NodeId id) {
    const uint32_t k = static_cast<uint32_t>(id) + shift;
    return static_cast<size_t>(first[k / 4] + static_cast<int32_t>(k % 4));
  }

  bool of_some_ = false;
  uint32_t shift_ = 0;
  size_t nodes_ = 0, count_ = 0, end_of_own_ = 0, first_element_ = 0;
  GrowingArray<int32_t> first_;  // per four nodes the place of the first
};

}  // namespace hrad
