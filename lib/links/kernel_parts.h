// A triangle in parts that are small as seen from a point, each about in proportion to what is seen
// of it. Floor 6 (links).
#pragma once

#include "links/element.h"

namespace hrad {

struct KernelPart {
  Node place;  // in the triangle
  double area, radius, distance, weight;
};

class KernelParts {
 public:
  // The heaviest part is divided as long as it is large for its distance.
  void divide(Vec3 x, Vec3 normal, const Element& large);

  double sum() const { return end_[count_ - 1]; }
  // The part at this share of the sum of all weights.
  const KernelPart& at(double share) const;

 private:
  static constexpr int most_divisions = 8;
  static constexpr int most_parts = 1 + 3 * most_divisions;
  KernelPart parts_[most_parts];
  double end_[most_parts];  // running sum of the weights
  int count_ = 0;
};

}  // namespace hrad
