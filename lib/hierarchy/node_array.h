// All nodes in 11 bytes each: brothers stand side by side and share what their parent says of them.
// Floor 5 (hierarchy).
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/growing_array.h"
#include "hierarchy/node.h"

namespace hrad {

// What sweeps and rays ask of every node they come by.
struct Stem {
  // The number of the family of its children, counted from 1; 0: it is a leaf.
  uint32_t family : 30;
  uint32_t light_points : 2;
  float exposed;
};
static_assert(sizeof(Stem) == 8, "nodes are to stay small");

// Roots, clusters and elements. Different nodes may be written to by different threads at once.
class NodeArray {
 public:
  static constexpr int64_t most_bytes_of_a_node = 12;

  NodeArray() = default;
  explicit NodeArray(size_t roots);
  // Clusters with no parents yet, behind the roots, before there are any elements.
  void add_clusters(size_t count);

  size_t size() const { return stems_.size(); }
  size_t first_element() const { return parent_of_top_.size(); }
  Node operator[](size_t k) const;
  NodeId first_child(size_t k) const { return first_of(stems_[k].family); }
  float exposed(size_t k) const { return stems_[k].exposed; }
  // A copy of each, one after the other.
  class Iterator;
  Iterator begin() const;
  Iterator end() const;
  void prefetch(NodeId k) const { __builtin_prefetch(&stems_[static_cast<size_t>(k)]); }
  const Stem* stems() const { return stems_.data(); }
  int64_t bytes() const {
    return bytes_in(stems_) + bytes_in(families_) + bytes_in(parent_of_top_);
  }

  void set_exposed(size_t k, float share) { stems_[k].exposed = share; }
  void set_light_points(size_t k, LightPoints points) { stems_[k].light_points = points; }
  void set_parent_of_top(size_t k, NodeId cluster) { parent_of_top_[k] = cluster; }
  // Makes the last nodes four at a time, of no parent before adopt(), or drops them: parents that
  // stay are to have lost them.
  void resize(size_t nodes);
  void reserve(size_t nodes);
  void shrink_to_fit();
  // The four nodes from `first` on become the children of a leaf, as exposed as that, which is
  // right where it is whole.
  void adopt(NodeId parent, NodeId first);
  void lose_children(size_t k) { stems_[k].family = 0; }

 private:
  // What a parent says of its four children. Its level is at most 14, and its coordinates are below
  // 2^level: a mark on top of i tells the level.
  struct Family {
    NodeId parent;
    int32_t surface;
    uint32_t i_and_level : 16;
    uint32_t j : 15;
    uint32_t inverted : 1;
  };
  static_assert(sizeof(Family) == 12, "nodes are to stay small");

  NodeId first_of(uint32_t family) const {
    return family == 0 ? -1 : static_cast<NodeId>(first_element() + 4 * (size_t{family} - 1));
  }

  size_t roots_ = 0;
  GrowingArray<NodeId> parent_of_top_;  // of roots and clusters
  GrowingArray<Stem> stems_;            // of all
  GrowingArray<Family> families_;       // of elements
};

class NodeArray::Iterator {
 public:
  Iterator(const NodeArray& nodes, size_t at) : nodes_(&nodes), at_(at) {}
  Node operator*() const { return (*nodes_)[at_]; }
  Iterator& operator++() {
    ++at_;
    return *this;
  }
  bool operator!=(const Iterator& other) const { return at_ != other.at_; }

 private:
  const NodeArray* nodes_;
  size_t at_;
};

inline NodeArray::Iterator NodeArray::begin() const { return {*this, 0}; }
inline NodeArray::Iterator NodeArray::end() const { return {*this, size()}; }

inline Node NodeArray::operator[](size_t k) const {
  Node node;
  if (k >= first_element()) {
    const size_t element = k - first_element();
    const Family& family = families_[element / 4];
    LatticePlace parent;
    parent.level = static_cast<uint8_t>(31 - __builtin_clz(family.i_and_level));
    parent.i = static_cast<uint16_t>(family.i_and_level - (1u << parent.level));
    parent.j = family.j;
    parent.inverted = family.inverted;
    static_cast<LatticePlace&>(node) = part_of(parent, static_cast<int>(element % 4));
    node.parent = family.parent;
    node.surface = family.surface;
  } else {
    node.parent = parent_of_top_[k];
    node.surface = k < roots_ ? static_cast<int32_t>(k) : -1 - static_cast<int32_t>(k - roots_);
  }
  const Stem& stem = stems_[k];
  node.first_child = first_of(stem.family);
  node.light_points = stem.light_points;
  node.exposed = stem.exposed;
  return node;
}

}  // namespace hrad
