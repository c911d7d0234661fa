// Growing, and families. Floor 5 (hierarchy).
#include "hierarchy/node_array.h"

#include <limits>

#include "base/error.h"

namespace hrad {
namespace {

constexpr Stem a_leaf = {0, at_corners, 1};

}  // namespace

void require_numbers(size_t nodes) {
  if (nodes > static_cast<size_t>(std::numeric_limits<NodeId>::max()))
    fail(Status::memory,
         "%zu elements are more than there are numbers for: use a larger accuracy or min_area",
         nodes);
}

NodeArray::NodeArray(size_t roots) {
  add_clusters(roots);
  roots_ = roots;
}

void NodeArray::add_clusters(size_t count) {
  for (size_t k = 0; k < count; ++k) {
    parent_of_top_.push_back(-1);
    stems_.push_back(a_leaf);
  }
}

void NodeArray::resize(size_t nodes) {
  stems_.resize_for_overwrite(nodes);
  families_.resize_for_overwrite((nodes - first_element()) / 4);
}

void NodeArray::reserve(size_t nodes) {
  stems_.reserve(nodes);
  families_.reserve((nodes - first_element()) / 4);
}

void NodeArray::shrink_to_fit() {
  parent_of_top_.shrink_to_fit();
  stems_.shrink_to_fit();
  families_.shrink_to_fit();
}

void NodeArray::adopt(NodeId parent, NodeId first) {
  const size_t number = (static_cast<size_t>(first) - first_element()) / 4;
  const Node above = (*this)[static_cast<size_t>(parent)];
  Family& family = families_[number];
  family.parent = parent;
  family.surface = above.surface;
  family.i_and_level = above.i | 1u << above.level;
  family.j = above.j;
  family.inverted = above.inverted;
  for (size_t child = 0; child < 4; ++child) {
    Stem& stem = stems_[static_cast<size_t>(first) + child];
    stem = a_leaf;
    stem.exposed = above.exposed;
  }
  stems_[static_cast<size_t>(parent)].family = static_cast<uint32_t>(number + 1);
}

}  // namespace hrad
