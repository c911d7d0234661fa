// The data of the builtin engine: a bounding-volume hierarchy of eight-wide
// nodes over blocks of up to eight triangles, all in single precision relative
// to the middle of the scene and laid out so that one vector instruction looks
// at eight boxes or eight triangles (Wald, Benthin, Boulos, "Getting rid of
// packets", 2008; Dammertz et al., "Shallow bounding volume hierarchies",
// 2008). Floor 4 (visibility).
#pragma once

#include <cstdint>
#include <vector>

namespace hrad {

constexpr int tree_width = 8;
// An entry of TreeNode::child with this bit is a leaf: in the three lowest bits its triangles less
// one, between them its number. Without it, the number of a node.
constexpr uint32_t tree_leaf_bit = 0x80000000u;
constexpr uint32_t leaf_reference(uint32_t number, uint32_t count) {
  return tree_leaf_bit | number << 3 | (count - 1);
}
constexpr uint32_t leaf_number(uint32_t reference) { return (reference & ~tree_leaf_bit) >> 3; }
// Bit i: lane i of the leaf holds a triangle.
constexpr uint32_t leaf_lanes(uint32_t reference) { return 0xffu >> (7 - (reference & 7u)); }
// Deepest level of nodes, kept by the builder: bounds the stack of a traversal.
constexpr int tree_max_depth = 72;
constexpr int tree_stack_size = tree_max_depth * (tree_width - 1) + tree_width;
// An unused child has low = +tree_nowhere and high = -tree_nowhere, which no
// ray meets. Finite, so that no product with it is NaN.
constexpr float tree_nowhere = 1e30f;
// Half of a slab test for a direction of zero; larger would overflow with
// scenes of 1e15 units.
constexpr float tree_steepest = 1e20f;

// low[axis][child], high[axis][child]; padded, so that rounding in a traversal
// loses no triangle.
struct alignas(64) TreeNode {
  float low[3][tree_width];
  float high[3][tree_width];
  uint32_t child[tree_width];
};

// corner[corner][axis][triangle]; normal has length 1. Unused lanes are zero, with the patch -1.
struct alignas(64) TreeLeaf {
  float corner[3][3][tree_width];
  float normal[3][tree_width];
  int32_t patch[tree_width];
};

struct Tree {
  std::vector<TreeNode> nodes;  // the root first; at least one
  std::vector<TreeLeaf> leaves;
};

}  // namespace hrad
