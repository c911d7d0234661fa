// Sixteen segments of one link against the tree. The segments run from a small region to another, so
// that one test of a box against their shaft, the convex hull of both regions' boxes, stands for all
// of them (Haines and Wallace, "Shaft culling for efficient ray-cast radiosity", 1991); only triangles
// are tested against the sixteen segments themselves. Included within an unnamed namespace after
// lanes.inl. Floor 4 (visibility).

// The segments, with inactive ones replaced by copies of an active one.
struct Bundle {
  Sixteen origin[3], direction[3];  // origin relative to `reference`
  Sixteen moment[3];                // 2 origin x direction
  float reference[3];               // near the origins: keeps products of coordinates small
};

// One side of the shaft: at the fraction t of the way it lies at origin + t / slope on its axis. A box
// limits t by (its own side - origin) * slope.
struct ShaftSide {
  uint32_t offset;  // of the box's side within TreeNode, in floats
  float origin, slope;
};

struct Shaft {
  ShaftSide lower[6], upper[6];  // sides that limit t from below and from above
  int lower_count = 0, upper_count = 0;
};

// The shaft's low side rises to meet a box's high side, or its high side the box's low side.
inline void add_side(Shaft& shaft, float from, float to, uint32_t offset, bool is_low) {
  const float rise = to - from;
  const bool limits_above = is_low ? rise >= 0 : rise <= 0;
  // A side that stays in place either limits nothing or everything.
  const float size = __builtin_fabsf(rise);
  const float steep = size > 1 / tree_steepest ? 1 / size : tree_steepest;
  const float slope = limits_above == is_low ? steep : -steep;
  if (limits_above)
    shaft.upper[shaft.upper_count++] = {offset, from, slope};
  else
    shaft.lower[shaft.lower_count++] = {offset, from, slope};
}

// Bit i: the shaft meets box i of eight: for some t between 0 and 1, the box of the places that the
// segments can be at overlaps with it. Exact but for rounding, since t is the one unknown.
inline uint32_t meets(const Shaft& shaft, const float* boxes) {
  Eight near = Eight::all(0), far = Eight::all(1);
  for (int i = 0; i < shaft.lower_count; ++i) {
    const ShaftSide& side = shaft.lower[i];
    near = greatest(near, (Eight::load(boxes + side.offset) - Eight::all(side.origin)) *
                              Eight::all(side.slope));
  }
  for (int i = 0; i < shaft.upper_count; ++i) {
    const ShaftSide& side = shaft.upper[i];
    far = least(far, (Eight::load(boxes + side.offset) - Eight::all(side.origin)) *
                         Eight::all(side.slope));
  }
  return less_equal(near, far);
}

inline float smallest(const Sixteen& a) {
  float lanes[16];
  a.store(lanes);
  float result = lanes[0];
  for (int i = 1; i < 16; ++i) result = lanes[i] < result ? lanes[i] : result;
  return result;
}

inline float largest(const Sixteen& a) {
  float lanes[16];
  a.store(lanes);
  float result = lanes[0];
  for (int i = 1; i < 16; ++i) result = lanes[i] > result ? lanes[i] : result;
  return result;
}

inline Sixteen load_active(const float* p, uint32_t active) {
  if (active == 0xffffu) return Sixteen::load(p);
  float lanes[16];
  const float filler = p[__builtin_ctz(active)];
  for (int i = 0; i < 16; ++i) lanes[i] = active >> i & 1 ? p[i] : filler;
  return Sixteen::load(lanes);
}

inline void prepare(const SegmentPacket& packet, uint32_t active, Bundle& bundle, Shaft& shaft) {
  const float* origins[3] = {packet.ox, packet.oy, packet.oz};
  const float* directions[3] = {packet.dx, packet.dy, packet.dz};
  for (int axis = 0; axis < 3; ++axis) {
    const Sixteen origin = load_active(origins[axis], active);
    const Sixteen direction = load_active(directions[axis], active);
    const Sixteen end = origin + direction;
    const float low = smallest(origin), high = largest(origin);
    add_side(shaft, low, smallest(end), (3 + axis) * tree_width, true);
    add_side(shaft, high, largest(end), axis * tree_width, false);
    bundle.reference[axis] = 0.5f * (low + high);
    bundle.origin[axis] = origin - Sixteen::all(bundle.reference[axis]);
    bundle.direction[axis] = direction;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    bundle.moment[axis] = Sixteen::all(2) * (bundle.origin[next] * bundle.direction[last] -
                                             bundle.origin[last] * bundle.direction[next]);
  }
}

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

// Which side of an edge the segments pass on: the product of their Pluecker coordinates. The two
// triangles at an edge get exactly opposite numbers, and zero counts as inside, so that no segment
// slips through between them.
inline Sixteen side_of(const PreparedLeaf& leaf, int triangle, int k, const Bundle& bundle) {
  Sixteen side = Sixteen::all(leaf.moment[k][0][triangle]) * bundle.direction[0];
  side = side + Sixteen::all(leaf.moment[k][1][triangle]) * bundle.direction[1];
  side = side + Sixteen::all(leaf.moment[k][2][triangle]) * bundle.direction[2];
  Sixteen shift = Sixteen::all(leaf.edge[k][0][triangle]) * bundle.moment[0];
  shift = shift + Sixteen::all(leaf.edge[k][1][triangle]) * bundle.moment[1];
  shift = shift + Sixteen::all(leaf.edge[k][2][triangle]) * bundle.moment[2];
  return side - shift;
}

// Bit i: segment i passes through the triangle's plane, 0 < t < 1.
inline uint32_t crosses_plane(const TreeLeaf& leaf, const PreparedLeaf& prepared, int triangle,
                              const Bundle& bundle) {
  const Sixteen nx = Sixteen::all(leaf.normal[0][triangle]);
  const Sixteen ny = Sixteen::all(leaf.normal[1][triangle]);
  const Sixteen nz = Sixteen::all(leaf.normal[2][triangle]);
  const Sixteen whole =
      nx * bundle.direction[0] + ny * bundle.direction[1] + nz * bundle.direction[2];
  const Sixteen part = Sixteen::all(prepared.plane[triangle]) -
                       (nx * bundle.origin[0] + ny * bundle.origin[1] + nz * bundle.origin[2]);
  return less(Sixteen::all(0), part * (whole - part));
}

inline uint32_t blocked_by_leaf(const TreeLeaf& leaf, int count, const Bundle& bundle,
                                uint32_t active) {
  PreparedLeaf prepared;
  prepare(leaf, bundle.reference, prepared);
  uint32_t found = 0;
  for (int i = 0; i < count; ++i) {
    const uint32_t crossing = crosses_plane(leaf, prepared, i, bundle) & (active & ~found);
    if (!crossing) continue;
    const Sixteen a = side_of(prepared, i, 0, bundle), b = side_of(prepared, i, 1, bundle),
                  c = side_of(prepared, i, 2, bundle);
    const Sixteen zero = Sixteen::all(0);
    const uint32_t inside = less_equal(zero, least(least(a, b), c)) |
                            less_equal(greatest(greatest(a, b), c), zero);
    found |= crossing & inside;
  }
  return found;
}

uint32_t blocked(const TreeView& tree, const SegmentPacket& packet) {
  const uint32_t wanted = packet.active & 0xffffu;
  if (!wanted) return 0;
  Bundle bundle;
  Shaft shaft;
  prepare(packet, wanted, bundle, shaft);
  uint32_t active = wanted;
  uint32_t stack[tree_stack_size];
  int size = 0;
  stack[size++] = 0;
  while (size) {
    const TreeNode& node = tree.nodes[stack[--size]];
    for (uint32_t mask = meets(shaft, &node.low[0][0]); mask; mask &= mask - 1) {
      const uint32_t child = node.child[__builtin_ctz(mask)];
      if (!(child & tree_leaf_bit)) {
        stack[size++] = child;
        continue;
      }
      const uint32_t leaf = child & ~tree_leaf_bit;
      active &= ~blocked_by_leaf(tree.leaves[leaf], tree.counts[leaf], bundle, active);
      if (!active) return wanted;
    }
  }
  return wanted & ~active;
}
