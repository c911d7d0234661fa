// Median splits along the longest side, ties by index. Floor 4 (visibility).
#include "visibility/box_tree.h"

#include <algorithm>
#include <utility>

namespace hrad {

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
  for (size_t k = 0; k < boxes_.size(); ++k)
    if (!boxes_[k].empty()) order_.push_back(static_cast<int32_t>(k));
  nodes_.push_back({});
  build(0, 0, static_cast<int32_t>(order_.size()));
}

void BoxTree::build(int32_t node, int32_t first, int32_t count) {
  Box box;
  for (int32_t k = first; k < first + count; ++k) box.grow(boxes_[order_[k]]);
  nodes_[node] = {box, first, count};
  if (count <= 8) return;
  const Vec3 e = box.extent();
  const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
  const int32_t half = count / 2;
  std::nth_element(order_.begin() + first, order_.begin() + first + half,
                   order_.begin() + first + count, [&](int32_t a, int32_t b) {
                     const double ca = boxes_[a].low[axis] + boxes_[a].high[axis];
                     const double cb = boxes_[b].low[axis] + boxes_[b].high[axis];
                     return ca != cb ? ca < cb : a < b;
                   });
  const int32_t children = static_cast<int32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].first = children;
  nodes_[node].count = 0;
  build(children, first, half);
  build(children + 1, first + half, count - half);
}

void BoxTree::overlapping(const Box& query, const std::function<void(int32_t)>& found) const {
  if (order_.empty()) return;
  std::vector<int32_t> stack{0};
  while (!stack.empty()) {
    const Node& node = nodes_[stack.back()];
    stack.pop_back();
    if (!overlap(node.box, query)) continue;
    if (node.count == 0) {
      stack.push_back(node.first + 1);
      stack.push_back(node.first);
      continue;
    }
    for (int32_t k = node.first; k < node.first + node.count; ++k)
      if (overlap(boxes_[order_[k]], query)) found(order_[k]);
  }
}

}  // namespace hrad
