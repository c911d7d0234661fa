// Where on a partly sealed element points are drawn: on the cells of a lattice less those that a
// single cover seals, so that few draws are in vain where little is exposed. Floor 6 (links).
#pragma once

#include <cstdint>
#include <vector>

#include "hierarchy/forest.h"
#include "visibility/exposure.h"

namespace hrad {

// For one thread.
class ExposedCells {
 public:
  // Of this triangle of a side.
  ExposedCells(const Exposure& exposure, const Surface& surface, const Triangle& corners)
      : part_(exposure, surface.patch, surface.side, corners), corners_(corners) {}

  bool exposed(double u, double v) { return !part_.sealed(corners_.at(u, v)); }

  // (u,v) of a point drawn evenly from all that is exposed. False: none was found, in as many draws
  // as it takes where a hundredth of the cells is exposed.
  bool draw(uint64_t key, float* u, float* v);

 private:
  void find_cells(const Node& place);

  Exposure::Part part_;
  Triangle corners_;
  std::vector<Node> cells_;
  bool found_ = false;  // the cells
};

}  // namespace hrad
