// One ray and its nearest triangle, near boxes first. Included within an unnamed namespace. Floor 4
// (visibility).
#pragma once

#include "visibility/ray_boxes.inl"

// Bit i: the ray's line passes on the same side of all three edges of triangle i; on an edge counts
// as inside. The same side products as for packets, with the ray's origin as the reference.
inline uint32_t lines_inside(const TreeLeaf& leaf, const float* origin, const float* towards) {
  Eight corner[3][3], direction[3];
  for (int axis = 0; axis < 3; ++axis) {
    direction[axis] = Eight::all(towards[axis]);
    for (int k = 0; k < 3; ++k)
      corner[k][axis] = Eight::load(leaf.corner[k][axis]) - Eight::all(origin[axis]);
  }
  Eight side[3];
  for (int k = 0; k < 3; ++k) {
    Eight edge[3], sum[3];
    for (int axis = 0; axis < 3; ++axis) {
      edge[axis] = corner[(k + 1) % 3][axis] - corner[k][axis];
      sum[axis] = corner[(k + 1) % 3][axis] + corner[k][axis];
    }
    side[k] = (edge[1] * sum[2] - edge[2] * sum[1]) * direction[0];
    side[k] = side[k] + (edge[2] * sum[0] - edge[0] * sum[2]) * direction[1];
    side[k] = side[k] + (edge[0] * sum[1] - edge[1] * sum[0]) * direction[2];
  }
  const Eight zero = Eight::all(0);
  return less_equal(zero, least(least(side[0], side[1]), side[2])) |
         less_equal(greatest(greatest(side[0], side[1]), side[2]), zero);
}

// The ray's way to the triangles' planes is part / whole.
inline void ways_to_planes(const TreeLeaf& leaf, const float* origin, const float* towards,
                           Eight& part, Eight& whole) {
  part = whole = Eight::all(0);
  for (int axis = 0; axis < 3; ++axis) {
    const Eight normal = Eight::load(leaf.normal[axis]);
    whole = whole + normal * Eight::all(towards[axis]);
    part = part + normal * (Eight::load(leaf.corner[0][axis]) - Eight::all(origin[axis]));
  }
}

// Takes the triangles of a leaf that are nearer than the hit so far.
inline void look_at_leaf(const TreeLeaf& leaf, uint32_t lanes, RayQuery& query) {
  lanes &= lines_inside(leaf, query.origin, query.direction);
  if (!lanes) return;
  Eight part, whole;
  ways_to_planes(leaf, query.origin, query.direction, part, whole);
  float parts[8], wholes[8];
  part.store(parts);
  whole.store(wholes);
  for (; lanes; lanes &= lanes - 1) {
    const int i = __builtin_ctz(lanes);
    if (wholes[i] == 0) continue;
    // Rounding grows as the ray grazes the triangle.
    const float t = parts[i] / wholes[i], doubt = query.band / __builtin_fabsf(wholes[i]);
    const int32_t patch = leaf.patch[i];
    if (t + doubt < query.t_min || t - doubt > query.t + query.doubt) continue;
    if (t - doubt <= query.t_min && !query.is_above_minimum(query, patch)) continue;
    if (t + doubt < query.t - query.doubt || query.is_nearer(query, patch, query.patch)) {
      query.t = t;
      query.doubt = doubt;
      query.patch = patch;
    }
  }
}

struct RayEntry {
  uint32_t child;
  float t;
};

// Puts the children of `mask` on the stack, the nearest on top.
inline int push_sorted(const TreeView& tree, const TreeNode& node, uint32_t mask,
                       const float* entry, RayEntry* stack, int size) {
  for (const int bottom = size; mask; mask &= mask - 1) {
    const int i = __builtin_ctz(mask);
    int place = size++;
    for (; place > bottom && stack[place - 1].t < entry[i]; --place)
      stack[place] = stack[place - 1];
    stack[place] = {node.child[i], entry[i]};
    fetch(tree, node.child[i]);
  }
  return size;
}

void nearest(const TreeView& tree, RayQuery& query) {
  const RayBoxes ray = prepare(query.origin, query.direction);
  const float first = query.t_min - query.band;
  RayEntry stack[tree_stack_size];
  int size = 0;
  stack[size++] = {0, first};
  while (size) {
    const RayEntry top = stack[--size];
    if (top.t > query.t + query.doubt) continue;
    uint32_t child = top.child;
    // Down to a leaf, on the stack what is left aside.
    while (!(child & tree_leaf_bit)) {
      const TreeNode& node = tree.nodes[child];
      float entry[8];
      const uint32_t mask = meets(ray, node, first, query.t + query.doubt, entry);
      if (!mask) break;
      if (!(mask & (mask - 1))) {
        child = node.child[__builtin_ctz(mask)];
        continue;
      }
      size = push_sorted(tree, node, mask, entry, stack, size);
      child = stack[--size].child;
    }
    if (child & tree_leaf_bit)
      look_at_leaf(tree.leaves[leaf_number(child)], leaf_lanes(child), query);
  }
}
