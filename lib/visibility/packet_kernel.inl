// Sixteen segments of one link against the tree. The segments run from a small region to another,
// so that one test of a box against their shaft, the convex hull of both regions' boxes, stands for
// all of them (Haines and Wallace, "Shaft culling for efficient ray-cast radiosity", 1991); only
// triangles are tested against the sixteen segments themselves. Included within an unnamed
// namespace after segment_kernel.inl. Floor 4 (visibility).
#pragma once

#include "visibility/segment_kernel.inl"

// The segments, as the tests see them.
struct Bundle {
  Sixteen place[3], slope[3];       // origins, and 1 / direction
  Sixteen origin[3], direction[3];  // origins relative to `reference`
  Sixteen moment[3];                // 2 origin x direction
  float reference[3];               // near the origins: keeps products of coordinates small
};

// The shaft. At the fraction t of the way each of its six sides lies somewhere between its places
// at the origins and at the ends. A box meets the shaft if for some t it is not beyond any side;
// each side limits either t from below or 1 - t, the way back from the ends: by (side of the box -
// origin) * slope. Sides that limit t come first.
struct Shaft {
  uint32_t offset[6];  // of the box's side that meets it within TreeNode, in floats
  float origin[6], slope[6];
  int forward = 0;              // how many limit t
  float low[2][3], high[2][3];  // the boxes around the origins and around the ends
};

// The smallest and the largest of each of the six rows of sixteen: rows of four at a time, whose
// columns are then compared.
inline void find_bounds(const float* const* origins, const float* const* directions, Shaft& shaft) {
  Four low[8], high[8];
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < 16; i += 4) {
      const Four origin = Four::load(origins[axis] + i);
      const Four end = origin + Four::load(directions[axis] + i);
      low[axis] = i ? least(low[axis], origin) : origin;
      high[axis] = i ? greatest(high[axis], origin) : origin;
      low[axis + 4] = i ? least(low[axis + 4], end) : end;
      high[axis + 4] = i ? greatest(high[axis + 4], end) : end;
    }
  }
  for (int end = 0; end < 2; ++end) {
    Four* l = low + 4 * end;
    Four* h = high + 4 * end;
    l[3] = l[2];
    h[3] = h[2];
    transpose(l);
    transpose(h);
    float lows[4], highs[4];
    least(least(l[0], l[1]), least(l[2], l[3])).store(lows);
    greatest(greatest(h[0], h[1]), greatest(h[2], h[3])).store(highs);
    for (int axis = 0; axis < 3; ++axis) {
      shaft.low[end][axis] = lows[axis];
      shaft.high[end][axis] = highs[axis];
    }
  }
}

// The low sides of the shaft meet the high sides of boxes, the high sides the low ones.
inline void find_sides(Shaft& shaft) {
  float steepness[6], origins[6];
  uint32_t is_forward[6];
  for (int side = 0; side < 6; ++side) {
    const int axis = side >> 1;
    const bool is_low = side & 1;
    const float from = is_low ? shaft.low[0][axis] : shaft.high[0][axis];
    const float to = is_low ? shaft.low[1][axis] : shaft.high[1][axis];
    const float rise = to - from;
    // A side that stays in place limits either nothing or everything.
    const float size = __builtin_fabsf(rise);
    const float steep = 1 / (size > 1 / tree_steepest ? size : 1 / tree_steepest);
    steepness[side] = is_low ? -steep : steep;
    is_forward[side] = is_low ? rise < 0 : rise > 0;
    origins[side] = is_forward[side] ? from : to;
  }
  // Without branches: half of these signs can't be predicted.
  const int forward =
      is_forward[0] + is_forward[1] + is_forward[2] + is_forward[3] + is_forward[4] + is_forward[5];
  uint32_t first = 0, second = forward;
  for (int side = 0; side < 6; ++side) {
    const uint32_t place = is_forward[side] ? first : second;
    first += is_forward[side];
    second += 1 - is_forward[side];
    shaft.offset[place] = ((side & 1) * 3 + (side >> 1)) * tree_width;
    shaft.origin[place] = origins[side];
    shaft.slope[place] = steepness[side];
  }
  shaft.forward = forward;
}

inline void prepare(const SegmentPacket& packet, Bundle& bundle, Shaft& shaft) {
  const float* origins[3] = {packet.ox, packet.oy, packet.oz};
  const float* directions[3] = {packet.dx, packet.dy, packet.dz};
  find_bounds(origins, directions, shaft);
  find_sides(shaft);
  const Sixteen zero = Sixteen::all(0), one = Sixteen::all(1);
  const Sixteen flattest = Sixteen::all(1 / tree_steepest);
  for (int axis = 0; axis < 3; ++axis) {
    const Sixteen origin = Sixteen::load(origins[axis]);
    const Sixteen direction = Sixteen::load(directions[axis]);
    bundle.reference[axis] = 0.5f * (shaft.low[0][axis] + shaft.high[0][axis]);
    bundle.place[axis] = origin;
    bundle.slope[axis] = one / where_negative(direction, least(direction, zero - flattest),
                                              greatest(direction, flattest));
    bundle.origin[axis] = origin - Sixteen::all(bundle.reference[axis]);
    bundle.direction[axis] = direction;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    bundle.moment[axis] = Sixteen::all(2) * (bundle.origin[next] * bundle.direction[last] -
                                             bundle.origin[last] * bundle.direction[next]);
  }
}

// A shaft with `forward` sides that limit t, spread over lanes.
template <int forward>
struct WideShaft {
  uint32_t offset[6];
  Eight origin[6], slope[6];

  explicit WideShaft(const Shaft& shaft) {
    for (int i = 0; i < 6; ++i) {
      offset[i] = shaft.offset[i];
      origin[i] = Eight::all(shaft.origin[i]);
      slope[i] = Eight::all(shaft.slope[i]);
    }
  }
  // Bit i: the shaft meets box i of eight.
  uint32_t meets(const float* boxes) const {
    Eight there = Eight::all(0), back = Eight::all(0);
    for (int i = 0; i < 6; ++i) {
      const Eight limit = (Eight::load(boxes + offset[i]) - origin[i]) * slope[i];
      if (i < forward)
        there = greatest(there, limit);
      else
        back = greatest(back, limit);
    }
    return less_equal(there + back, Eight::all(1));
  }
};

// Bit i: segment i meets the box.
inline uint32_t segments_meeting(const TreeNode& node, int child, const Bundle& bundle) {
  Sixteen near = Sixteen::all(0), far = Sixteen::all(1);
  for (int axis = 0; axis < 3; ++axis) {
    const Sixteen place = bundle.place[axis], slope = bundle.slope[axis];
    const Sixteen a = (Sixteen::all(node.low[axis][child]) - place) * slope;
    const Sixteen b = (Sixteen::all(node.high[axis][child]) - place) * slope;
    near = greatest(near, least(a, b));
    far = least(far, greatest(a, b));
  }
  return less_equal(near, far);
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

// Bit i: the shaft meets the box of triangle i.
template <int forward>
inline uint32_t candidates(const TreeLeaf& leaf, const WideShaft<forward>& shaft, float padding) {
  Eight corner[3][3];
  float boxes[6 * tree_width];
  const Eight pad = Eight::all(padding);
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 3; ++k) corner[k][axis] = Eight::load(leaf.corner[k][axis]);
    const Eight low = least(least(corner[0][axis], corner[1][axis]), corner[2][axis]);
    const Eight high = greatest(greatest(corner[0][axis], corner[1][axis]), corner[2][axis]);
    (low - pad).store(boxes + axis * tree_width);
    (high + pad).store(boxes + (3 + axis) * tree_width);
  }
  return shaft.meets(boxes);
}

// Bit i: a triangle of the leaf blocks segment i, one of `active`.
inline uint32_t blocked_by_leaf(const TreeLeaf& leaf, uint32_t todo, const Bundle& bundle,
                                uint32_t active) {
  PreparedLeaf prepared;
  prepare(leaf, bundle.reference, prepared);
  uint32_t found = 0;
  for (; todo; todo &= todo - 1) {
    const int i = __builtin_ctz(todo);
    const uint32_t crossing = crosses_plane(leaf, prepared, i, bundle) & (active & ~found);
    if (!crossing) continue;
    const Sixteen a = side_of(prepared, i, 0, bundle), b = side_of(prepared, i, 1, bundle),
                  c = side_of(prepared, i, 2, bundle);
    const Sixteen zero = Sixteen::all(0);
    const uint32_t inside =
        less_equal(zero, least(least(a, b), c)) | less_equal(greatest(greatest(a, b), c), zero);
    found |= crossing & inside;
  }
  return found;
}

// A shaft that has looked into this many nodes and found its leaves met by fewer segments than
// these on average is given up for single segments. Packets of a link seldom get there; the shaft
// of unrelated segments fills the scene.
constexpr int patient_nodes = 24, worthwhile_segments = 2;

// Bit i: segment i, of those in `active`, is blocked by something in the subtrees on the stack.
inline uint32_t blocked_singly(const TreeView& tree, const Bundle& bundle, uint32_t active,
                               const uint32_t* subtrees, int count) {
  float place[3][16], origin[3][16], direction[3][16], moment[3][16];
  for (int axis = 0; axis < 3; ++axis) {
    bundle.place[axis].store(place[axis]);
    bundle.origin[axis].store(origin[axis]);
    bundle.direction[axis].store(direction[axis]);
    bundle.moment[axis].store(moment[axis]);
  }
  uint32_t found = 0;
  for (; active; active &= active - 1) {
    const int i = __builtin_ctz(active);
    Segment segment;
    for (int axis = 0; axis < 3; ++axis) {
      segment.place[axis] = place[axis][i];
      segment.origin[axis] = origin[axis][i];
      segment.direction[axis] = direction[axis][i];
      segment.moment[axis] = moment[axis][i];
    }
    segment.reference = bundle.reference;
    uint32_t stack[tree_stack_size];
    __builtin_memcpy(stack, subtrees, count * sizeof stack[0]);
    found |= static_cast<uint32_t>(is_blocked(tree, segment, stack, count)) << i;
  }
  return found;
}

template <int forward>
uint32_t traverse(const TreeView& tree, const Bundle& bundle, const Shaft& shaft, uint32_t wanted) {
  const WideShaft<forward> wide(shaft);
  uint32_t active = wanted;
  uint32_t stack[tree_stack_size];
  int size = 0;
  stack[size++] = 0;
  int tests = 0, meetings = 0;  // of leaves' boxes with segments
  for (int visited = 0; size; ++visited) {
    if (visited >= patient_nodes && meetings < worthwhile_segments * tests) {
      active &= ~blocked_singly(tree, bundle, active, stack, size);
      break;
    }
    const TreeNode& node = tree.nodes[stack[--size]];
    for (uint32_t mask = wide.meets(&node.low[0][0]); mask; mask &= mask - 1) {
      const int i = __builtin_ctz(mask);
      const uint32_t child = node.child[i];
      if (!(child & tree_leaf_bit)) {
        stack[size++] = child;
        continue;
      }
      const uint32_t some = active & segments_meeting(node, i, bundle);
      ++tests;
      if (!some) continue;
      meetings += __builtin_popcount(some);
      const TreeLeaf& leaf = tree.leaves[leaf_number(child)];
      const uint32_t todo = candidates(leaf, wide, tree.padding) & leaf_lanes(child);
      if (!todo) continue;
      active &= ~blocked_by_leaf(leaf, todo, bundle, some);
      if (!active) return wanted;
    }
  }
  return wanted & ~active;
}

uint32_t blocked(const TreeView& tree, const SegmentPacket& packet) {
  const uint32_t wanted = packet.active & 0xffffu;
  if (!wanted) return 0;
  Bundle bundle;
  Shaft shaft;
  if (wanted == 0xffffu) {
    prepare(packet, bundle, shaft);
  } else {  // what is not looked at may hold anything: put copies of an active segment there
    SegmentPacket filled;
    const int example = __builtin_ctz(wanted);
    for (int i = 0; i < 16; ++i) {
      const int from = wanted >> i & 1 ? i : example;
      filled.ox[i] = packet.ox[from];
      filled.oy[i] = packet.oy[from];
      filled.oz[i] = packet.oz[from];
      filled.dx[i] = packet.dx[from];
      filled.dy[i] = packet.dy[from];
      filled.dz[i] = packet.dz[from];
    }
    prepare(filled, bundle, shaft);
  }
  switch (shaft.forward) {
    case 0:
      return traverse<0>(tree, bundle, shaft, wanted);
    case 1:
      return traverse<1>(tree, bundle, shaft, wanted);
    case 2:
      return traverse<2>(tree, bundle, shaft, wanted);
    case 3:
      return traverse<3>(tree, bundle, shaft, wanted);
    case 4:
      return traverse<4>(tree, bundle, shaft, wanted);
    case 5:
      return traverse<5>(tree, bundle, shaft, wanted);
    default:
      return traverse<6>(tree, bundle, shaft, wanted);
  }
}
