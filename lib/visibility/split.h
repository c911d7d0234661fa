// Where to cut a set of triangles in two: the surface area heuristic over bins of centroids (Wald,
// "On fast construction of SAH-based bounding volume hierarchies", 2007). Counts and boxes alone
// enter, so that the result does not depend on the order in which bins were filled. Floor 4
// (visibility).
#pragma once

#include <cstdint>

namespace hrad {

// Triangles are looked at in blocks of as many.
constexpr int64_t block_size = 8;

struct FloatBox {
  float low[3] = {1e30f, 1e30f, 1e30f}, high[3] = {-1e30f, -1e30f, -1e30f};

  void grow(const float* other_low, const float* other_high) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = other_low[axis] < low[axis] ? other_low[axis] : low[axis];
      high[axis] = other_high[axis] > high[axis] ? other_high[axis] : high[axis];
    }
  }
  void grow(const FloatBox& b) { grow(b.low, b.high); }
  // Half of the surface.
  float area() const {
    const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
  }
};

// A triangle on its way into the tree.
struct BuildItem {
  float low[3], high[3];
  int32_t patch;
  // Twice the middle of the box.
  float middle(int axis) const { return low[axis] + high[axis]; }
};

// A run of items, the box of their triangles and that of their middles.
struct BuildRange {
  int64_t begin = 0, end = 0;
  FloatBox box, middles;
  int64_t count() const { return end - begin; }
};

void measure(const BuildItem* items, BuildRange& range);

// The triangles by the place of their middles.
class Bins {
 public:
  explicit Bins(const BuildRange& range);
  void add(const BuildItem* first, const BuildItem* last);
  void add(const Bins& other);
  int bin_of(const BuildItem& item, int axis) const {
    const int bin = static_cast<int>((item.middle(axis) - origin_[axis]) * scale_[axis]);
    return bin < bin_count - 1 ? bin : bin_count - 1;
  }

  // Items whose bin on the axis is lower go to the left. Axis -1: no cut separates anything.
  struct Cut {
    int axis = -1, bin = 0;
    int64_t left_count = 0;
    float cost = 0;  // area x blocks of triangles, summed over both sides
  };
  Cut best() const;

 private:
  static constexpr int bin_count = 16;
  struct Bin {
    FloatBox box;
    int64_t count = 0;
  };
  float origin_[3], scale_[3];
  Bin bins_[3][bin_count];
};

}  // namespace hrad
