// Single segments of a packet that is too wide for a shaft: whether anything blocks them. The
// products are those of the packet bit by bit, since a segment that has seen one of two triangles
// in its packet and the other alone must not slip through between them. Included within an unnamed
// namespace. Floor 4 (visibility).
#pragma once

#include "visibility/ray_boxes.inl"

// Eight triangles' numbers that do not depend on the segment.
struct PreparedLeaf {
  float edge[3][3][8], moment[3][3][8];  // edge, and edge x (sum of its ends)
  float plane[8];                        // normal . corner
};

inline void prepare(const TreeLeaf& leaf, const float* reference, PreparedLeaf& prepared) {
  Eight corner[3][3];
  for (int k = 0; k < 3; ++k)
    for (int axis = 0; axis < 3; ++axis)
      corner[k][axis] = Eight::load(leaf.corner[k][axis]) - Eight::all(reference[axis]);
  for (int k = 0; k < 3; ++k) {
    Eight edge[3], sum[3];
    for (int axis = 0; axis < 3; ++axis) {
      edge[axis] = corner[(k + 1) % 3][axis] - corner[k][axis];
      sum[axis] = corner[(k + 1) % 3][axis] + corner[k][axis];
      edge[axis].store(prepared.edge[k][axis]);
    }
    for (int axis = 0; axis < 3; ++axis) {
      const int next = (axis + 1) % 3, last = (axis + 2) % 3;
      (edge[next] * sum[last] - edge[last] * sum[next]).store(prepared.moment[k][axis]);
    }
  }
  Eight plane = Eight::load(leaf.normal[0]) * corner[0][0];
  plane = plane + Eight::load(leaf.normal[1]) * corner[0][1];
  plane = plane + Eight::load(leaf.normal[2]) * corner[0][2];
  plane.store(prepared.plane);
}

struct Segment {
  float place[3];                            // origin
  float origin[3], direction[3], moment[3];  // as in Bundle
  const float* reference;
};

// ((a[0] b[0] + a[1] b[1]) + a[2] b[2]), one of the factors spread over the lanes.
inline Eight sum_of_products(const float (*a)[8], const float* b) {
  Eight sum = Eight::load(a[0]) * Eight::all(b[0]);
  sum = sum + Eight::load(a[1]) * Eight::all(b[1]);
  return sum + Eight::load(a[2]) * Eight::all(b[2]);
}

// Bit i: triangle i lies across the segment, 0 < t < 1.
inline uint32_t lies_across(const TreeLeaf& leaf, const Segment& segment) {
  PreparedLeaf prepared;
  prepare(leaf, segment.reference, prepared);
  const Eight whole = sum_of_products(leaf.normal, segment.direction);
  const Eight part = Eight::load(prepared.plane) - sum_of_products(leaf.normal, segment.origin);
  const Eight zero = Eight::all(0);
  const uint32_t crossing = less(zero, part * (whole - part));
  if (!crossing) return 0;
  Eight side[3];
  for (int k = 0; k < 3; ++k)
    side[k] = sum_of_products(prepared.moment[k], segment.direction) -
              sum_of_products(prepared.edge[k], segment.moment);
  return crossing & (less_equal(zero, least(least(side[0], side[1]), side[2])) |
                     less_equal(greatest(greatest(side[0], side[1]), side[2]), zero));
}

// Looks at the subtrees on the stack.
inline bool is_blocked(const TreeView& tree, const Segment& segment, uint32_t* stack, int size) {
  const RayBoxes ray = prepare(segment.place, segment.direction);
  while (size) {
    const uint32_t child = stack[--size];
    if (child & tree_leaf_bit) {
      const TreeLeaf& leaf = tree.leaves[leaf_number(child)];
      if (lies_across(leaf, segment) & leaf_lanes(child)) return true;
      continue;
    }
    const TreeNode& node = tree.nodes[child];
    float entry[8];
    for (uint32_t mask = meets(ray, node, 0, 1, entry); mask; mask &= mask - 1) {
      stack[size++] = node.child[__builtin_ctz(mask)];
      fetch(tree, stack[size - 1]);
    }
  }
  return false;
}
