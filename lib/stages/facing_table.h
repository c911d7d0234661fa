// Which surfaces face each other at all: the first test of every pair. Floor 7 (stages).
#pragma once

#include <cstdint>
#include <vector>

#include "links/element.h"

namespace hrad {

// Corners and planes of all surfaces side by side in single precision: facing tests of one surface
// against all others run along these arrays.
class FacingTable {
 public:
  // margin: how far before a plane a corner must lie.
  FacingTable(const std::vector<Element>& roots, Vec3 center, double margin);

  // faces[q - first] = 1 where some of q lies before p's plane and some of p before q's.
  void find(size_t p, size_t first, size_t count, uint8_t* faces) const;

 private:
  std::vector<float> corner_[3][3];  // [corner][axis]
  std::vector<float> normal_[3], distance_;
  const float margin_;
};

}  // namespace hrad
