// The surface area heuristic over bins. Floor 4 (visibility).
#include "visibility/split.h"

namespace hrad {

void measure(const BuildItem* items, BuildRange& range) {
  for (int64_t i = range.begin; i < range.end; ++i) {
    const BuildItem& item = items[i];
    const float middle[3] = {item.middle(0), item.middle(1), item.middle(2)};
    range.box.grow(item.low, item.high);
    range.middles.grow(middle, middle);
  }
}

Bins::Bins(const BuildRange& range) {
  for (int axis = 0; axis < 3; ++axis) {
    const float extent = range.middles.high[axis] - range.middles.low[axis];
    origin_[axis] = range.middles.low[axis];
    scale_[axis] = extent > 1e-30f ? static_cast<float>(bin_count) / extent : 0;
  }
}

void Bins::add(const BuildItem* first, const BuildItem* last) {
  for (const BuildItem* item = first; item != last; ++item) {
    for (int axis = 0; axis < 3; ++axis) {
      Bin& bin = bins_[axis][bin_of(*item, axis)];
      bin.box.grow(item->low, item->high);
      ++bin.count;
    }
  }
}

void Bins::add(const Bins& other) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < bin_count; ++i) {
      bins_[axis][i].box.grow(other.bins_[axis][i].box);
      bins_[axis][i].count += other.bins_[axis][i].count;
    }
  }
}

namespace {

// What a side costs: kernels look at a leaf's triangles together.
int64_t blocks(int64_t count) { return (count + block_size - 1) / block_size; }

}  // namespace

Bins::Cut Bins::best() const {
  Cut best;
  for (int axis = 0; axis < 3; ++axis) {
    // From the right the cost of every right side, from the left that of the whole cut.
    float right_cost[bin_count];
    int64_t right_count[bin_count];
    FloatBox box;
    int64_t count = 0;
    for (int i = bin_count - 1; i > 0; --i) {
      box.grow(bins_[axis][i].box);
      count += bins_[axis][i].count;
      right_cost[i] = box.area() * static_cast<float>(blocks(count));
      right_count[i] = count;
    }
    box = FloatBox();
    count = 0;
    for (int i = 1; i < bin_count; ++i) {
      box.grow(bins_[axis][i - 1].box);
      count += bins_[axis][i - 1].count;
      if (count == 0 || right_count[i] == 0) continue;
      const float cost = box.area() * static_cast<float>(blocks(count)) + right_cost[i];
      if (best.axis < 0 || cost < best.cost) best = {axis, i, count, cost};
    }
  }
  return best;
}

}  // namespace hrad
