// A small hierarchy of boxes that answers which of them a box overlaps. Floor 4 (visibility).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/vec3.h"

namespace hrad {

// Also where they only touch.
inline bool overlap(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes);

  // Calls found(index) for every box that overlaps or touches `query`, in an order that depends on
  // the boxes alone.
  void overlapping(const Box& query, const std::function<void(int32_t)>& found) const;

 private:
  struct Node {
    Box box;
    int32_t first, count;  // leaf: a run of order_; inner: count 0, children first and first+1
  };
  void build(int32_t node, int32_t first, int32_t count);

  std::vector<Box> boxes_;
  std::vector<int32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace hrad
