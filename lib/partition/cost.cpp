// Recursive bisection by predicted work (paper, Section 4, future work). Floor 6 (partition).
#include <algorithm>
#include <cmath>
#include <numeric>

#include "partition/partition.h"

namespace hrad {
namespace {

class Bisection {
 public:
  Bisection(const std::vector<PartitionItem>& items, std::vector<int32_t>& result)
      : items_(items), result_(result), order_(items.size()) {
    std::iota(order_.begin(), order_.end(), size_t{0});
  }

  // Items order_[begin] to order_[end-1] go to `ranks` ranks from `first` on. No deeper than the
  // logarithm of the number of ranks.
  void divide(size_t begin, size_t end, int32_t first, int32_t ranks) {
    if (ranks == 1 || begin == end) {
      for (size_t k = begin; k < end; ++k) result_[order_[k]] = first;
      return;
    }
    sort_along_longest_side(begin, end);
    const int32_t lower = ranks / 2;
    const size_t cut = cut_at(begin, end, static_cast<double>(lower) / ranks);
    divide(begin, cut, first, lower);
    divide(cut, end, first + lower, ranks - lower);
  }

 private:
  void sort_along_longest_side(size_t begin, size_t end) {
    Box box;
    for (size_t k = begin; k < end; ++k) box.grow(items_[order_[k]].place);
    const Vec3 extent = box.extent();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    const auto at = [&](size_t begin_or_end) {
      return order_.begin() + static_cast<std::ptrdiff_t>(begin_or_end);
    };
    std::sort(at(begin), at(end), [&](size_t a, size_t b) {
      const double x = items_[a].place[axis], y = items_[b].place[axis];
      return x != y ? x < y : items_[a].patch < items_[b].patch;
    });
  }

  // Before it stands as nearly as can be this share of the work, or of the items where there is
  // none.
  size_t cut_at(size_t begin, size_t end, double share) const {
    double total = 0;
    for (size_t k = begin; k < end; ++k) total += items_[order_[k]].work;
    if (!(total > 0)) return begin + static_cast<size_t>(share * static_cast<double>(end - begin));
    double before = 0;
    for (size_t k = begin; k < end; ++k) {
      const double after = before + items_[order_[k]].work;
      if (after >= share * total) return after - share * total < share * total - before ? k + 1 : k;
      before = after;
    }
    return end;
  }

  const std::vector<PartitionItem>& items_;
  std::vector<int32_t>& result_;
  std::vector<size_t> order_;
};

}  // namespace

std::vector<int32_t> divide_by_cost(const std::vector<PartitionItem>& items, int32_t ranks) {
  std::vector<int32_t> result(items.size(), 0);
  Bisection(items, result).divide(0, items.size(), 0, ranks);
  return result;
}

}  // namespace hrad
