// Dividing by the kernel. Floor 6 (links).
#include "links/kernel_parts.h"

#include <algorithm>
#include <cmath>

#include "links/pair_samples.h"

namespace hrad {
namespace {

// Parts larger than this share of their distance are divided.
constexpr double small_enough = 0.5;

// The form factor of a sphere of the part's size, never nothing: pairs are weighted by what they
// really bring, so that a wrong guess costs accuracy and no light.
void weigh(Vec3 x, Vec3 normal, const Element& large, KernelPart& part) {
  float u, v;
  point_in_place(part.place, 1.0 / 3, 1.0 / 3, &u, &v);
  const Vec3 d = large.corners.at(u, v) - x;
  const double distance2 = dot(d, d);
  part.distance = std::sqrt(distance2);
  const double reach = part.distance + part.radius;
  const double at_small = std::max(0.0, dot(d, normal)) + 0.3 * part.radius;
  const double at_large = std::max(0.0, -dot(d, large.normal)) + 0.3 * part.radius;
  const double size2 = distance2 + part.radius * part.radius / 4;
  part.weight = part.area * (at_small + 0.02 * reach) * (at_large + 0.02 * reach) / (size2 * size2);
}

}  // namespace

void KernelParts::divide(Vec3 x, Vec3 normal, const Element& large) {
  parts_[0] = {Node{}, large.area, large.radius, 0, 0};
  weigh(x, normal, large, parts_[0]);
  count_ = 1;
  for (int division = 0; division < most_divisions; ++division) {
    int heaviest = -1;
    for (int k = 0; k < count_; ++k)
      if (parts_[k].radius > small_enough * parts_[k].distance &&
          (heaviest < 0 || parts_[k].weight > parts_[heaviest].weight))
        heaviest = k;
    if (heaviest < 0) break;
    const KernelPart whole = parts_[heaviest];
    for (int k = 0; k < 4; ++k) {
      KernelPart& part = k == 0 ? parts_[heaviest] : parts_[count_++];
      part = {child_place(whole.place, k), whole.area / 4, whole.radius / 2, 0, 0};
      weigh(x, normal, large, part);
    }
  }
  for (int k = 0; k < count_; ++k) end_[k] = (k > 0 ? end_[k - 1] : 0) + parts_[k].weight;
}

const KernelPart& KernelParts::at(double share) const {
  return parts_[std::upper_bound(end_, end_ + count_ - 1, share * sum()) - end_];
}

}  // namespace hrad
