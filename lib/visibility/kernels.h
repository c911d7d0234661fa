// The functions that are compiled once per instruction set, and how they are
// found. Every set gives the same bits. Floor 4 (visibility).
#pragma once

#include <cstdint>

#include "visibility/tree.h"
#include "visibility/visibility.h"

namespace hrad {

// What a kernel sees of a tree.
struct TreeView {
  const TreeNode* nodes;
  const TreeLeaf* leaves;
  float padding;  // of the boxes
};

// One ray in search of its nearest triangle. Single precision can't say which
// of two near hits comes first, nor if a hit lies just above t_min: hits closer
// than `band` to the bound in question are decided by the two functions, which
// see double precision.
struct RayQuery {
  float origin[3];     // relative to the center
  float direction[3];  // of length 1
  float t_min;
  float band;  // bound of the rounding of a distance from a plane
  bool (*is_above_minimum)(const RayQuery& query, int32_t patch);
  bool (*is_nearer)(const RayQuery& query, int32_t patch, int32_t than);
  const void* context;  // for those functions
  // Result, the hit so far: its place, the bound of that one's rounding, and
  // its patch, -1 for none.
  float t, doubt;
  int32_t patch;
};

struct Kernels {
  const char* instruction_set;
  uint32_t (*blocked)(const TreeView& tree, const SegmentPacket& packet);
  void (*nearest)(const TreeView& tree, RayQuery& query);
};

const Kernels& kernels_sse2();  // on other processors: the generic form of the same operations
#ifdef HRAD_X86_KERNELS
const Kernels& kernels_avx2();
const Kernels& kernels_avx512();
#endif

// The kernels of an instruction set, or for "auto" of the widest that this
// processor has. ARGUMENT for a set that it lacks or that isn't known.
const Kernels& choose_kernels(const char* instruction_set);

}  // namespace hrad
