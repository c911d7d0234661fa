// One ray against the eight boxes of a node. Included within an unnamed namespace.
// Floor 4 (visibility).
#pragma once

#include "visibility/lanes.inl"

// A ray as boxes see it. slope: 1 / direction, finite; near and far: the sides that it meets first
// and last, within TreeNode in floats.
struct RayBoxes {
  Eight origin[3], slope[3];
  size_t near[3], far[3];
};

inline RayBoxes prepare(const float* origin, const float* direction) {
  RayBoxes ray;
  for (size_t axis = 0; axis < 3; ++axis) {
    const float d = direction[axis];
    const float size = __builtin_fabsf(d);
    const float steep = 1 / (size > 1 / tree_steepest ? size : 1 / tree_steepest);
    const size_t low = axis * tree_width, high = (3 + axis) * tree_width;
    ray.slope[axis] = Eight::all(d < 0 ? -steep : steep);
    ray.origin[axis] = Eight::all(origin[axis]);
    ray.near[axis] = d < 0 ? high : low;
    ray.far[axis] = low + high - ray.near[axis];
  }
  return ray;
}

// Bit i: the ray meets box i between `first` and `last`; entry: where it enters.
inline uint32_t meets(const RayBoxes& ray, const TreeNode& node, float first, float last,
                      float* entry) {
  Eight near = Eight::all(first), far = Eight::all(last);
  const float* boxes = &node.low[0][0];
  for (int axis = 0; axis < 3; ++axis) {
    near =
        greatest(near, (Eight::load(boxes + ray.near[axis]) - ray.origin[axis]) * ray.slope[axis]);
    far = least(far, (Eight::load(boxes + ray.far[axis]) - ray.origin[axis]) * ray.slope[axis]);
  }
  near.store(entry);
  return less_equal(near, far);
}

// Starts bringing what was put on a stack into the cache.
inline void fetch(const TreeView& tree, uint32_t child) {
  const char* p = child & tree_leaf_bit
                      ? reinterpret_cast<const char*>(tree.leaves + leaf_number(child))
                      : reinterpret_cast<const char*>(tree.nodes + child);
  __builtin_prefetch(p);
  __builtin_prefetch(p + 64);
  __builtin_prefetch(p + 128);
  __builtin_prefetch(p + 192);
  if (child & tree_leaf_bit) __builtin_prefetch(p + 256);
}
