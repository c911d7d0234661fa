// One ray and its nearest triangle: eight boxes or eight triangles at once, near boxes first.
// Included within an unnamed namespace after lanes.inl. Floor 4 (visibility).

struct RayBoxes {
  uint32_t near_offset[3],
      far_offset[3];          // of the sides met first and last within TreeNode, in floats
  float origin[3], slope[3];  // slope: 1 / direction
};

inline RayBoxes prepare(const RayQuery& query) {
  RayBoxes ray;
  for (int axis = 0; axis < 3; ++axis) {
    const float d = query.direction[axis];
    const float size = __builtin_fabsf(d);
    const float steep = size > 1 / tree_steepest ? 1 / size : tree_steepest;
    const uint32_t low = axis * tree_width, high = (3 + axis) * tree_width;
    ray.slope[axis] = d < 0 ? -steep : steep;
    ray.near_offset[axis] = d < 0 ? high : low;
    ray.far_offset[axis] = d < 0 ? low : high;
    ray.origin[axis] = query.origin[axis];
  }
  return ray;
}

// Bit i: the ray meets box i between `first` and `last`; entry: where it enters.
inline uint32_t meets(const RayBoxes& ray, const TreeNode& node, float first, float last,
                      float* entry) {
  Eight near = Eight::all(first), far = Eight::all(last);
  for (int axis = 0; axis < 3; ++axis) {
    const float* boxes = &node.low[0][0];
    const Eight origin = Eight::all(ray.origin[axis]), slope = Eight::all(ray.slope[axis]);
    near = greatest(near, (Eight::load(boxes + ray.near_offset[axis]) - origin) * slope);
    far = least(far, (Eight::load(boxes + ray.far_offset[axis]) - origin) * slope);
  }
  near.store(entry);
  return less_equal(near, far);
}

// Bit i: the ray's line goes through triangle i of the leaf, at distance t[i], wrong by doubt[i] at
// most, which grows as the ray grazes the triangle. The same side products as for packets, with the
// ray's origin as the reference.
inline uint32_t crosses(const TreeLeaf& leaf, const RayQuery& query, float* t, float* doubt) {
  Eight corner[3][3], direction[3];
  for (int axis = 0; axis < 3; ++axis) {
    direction[axis] = Eight::all(query.direction[axis]);
    for (int k = 0; k < 3; ++k)
      corner[k][axis] = Eight::load(leaf.corner[k][axis]) - Eight::all(query.origin[axis]);
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
  const uint32_t inside = less_equal(zero, least(least(side[0], side[1]), side[2])) |
                          less_equal(greatest(greatest(side[0], side[1]), side[2]), zero);
  Eight whole = zero, part = zero;
  for (int axis = 0; axis < 3; ++axis) {
    const Eight normal = Eight::load(leaf.normal[axis]);
    whole = whole + normal * direction[axis];
    part = part + normal * corner[0][axis];
  }
  const uint32_t oblique = less(whole, zero) | less(zero, whole);
  (part / whole).store(t);
  (Eight::all(query.band) / greatest(whole, zero - whole)).store(doubt);
  return inside & oblique;
}

// Takes the triangles of a leaf that are nearer than the hit so far.
inline void look_at_leaf(const TreeLeaf& leaf, RayQuery& query) {
  float t[8], doubt[8];
  for (uint32_t mask = crosses(leaf, query, t, doubt); mask; mask &= mask - 1) {
    const int i = __builtin_ctz(mask);
    const int32_t patch = leaf.patch[i];
    if (t[i] + doubt[i] < query.t_min || t[i] - doubt[i] > query.t + query.doubt) continue;
    if (t[i] - doubt[i] <= query.t_min && !query.is_above_minimum(query, patch)) continue;
    if (t[i] + doubt[i] < query.t - query.doubt || query.is_nearer(query, patch, query.patch)) {
      query.t = t[i];
      query.doubt = doubt[i];
      query.patch = patch;
    }
  }
}

void nearest(const TreeView& tree, RayQuery& query) {
  struct Entry {
    uint32_t child;
    float t;
  };
  const RayBoxes ray = prepare(query);
  const float first = query.t_min - query.band;
  Entry stack[tree_stack_size];
  int size = 0;
  stack[size++] = {0, first};
  while (size) {
    const Entry top = stack[--size];
    if (top.t > query.t + query.doubt) continue;
    if (top.child & tree_leaf_bit) {
      look_at_leaf(tree.leaves[top.child & ~tree_leaf_bit], query);
      continue;
    }
    const TreeNode& node = tree.nodes[top.child];
    float entry[8];
    uint32_t mask = meets(ray, node, first, query.t + query.doubt, entry);
    // Children go on the stack with the nearest on top.
    for (const int bottom = size; mask; mask &= mask - 1) {
      const int i = __builtin_ctz(mask);
      int place = size++;
      for (; place > bottom && stack[place - 1].t < entry[i]; --place)
        stack[place] = stack[place - 1];
      stack[place] = {node.child[i], entry[i]};
    }
  }
}
