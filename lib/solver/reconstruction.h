// Linear reconstruction: irradiance at the corners of the leaves from the means of the leaves around
// them, so that pictures and point queries show no steps between elements. Floor 8 (solver).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hierarchy/forest.h"

namespace hrad {

class Reconstruction {
 public:
  // irradiance: `bands` numbers per node, means over the exposed part. Leaves meet at a corner
  // within one surface and across the edges it shares with surfaces of the same plane; they weigh
  // in with their exposed share over their size. The value at a corner that lies within a longer edge of a neighbour
  // is that edge's own, so that no cracks open.
  Reconstruction(const Forest& forest, int bands, const std::vector<NodeId>& leaves,
                 const std::vector<float>& irradiance);

  // Irradiance at the three corners of a leaf, in the order of Forest::triangle: 3*bands values.
  void corners(NodeId leaf, double* out) const;

  // The numbers of its corners: leaves of one plane that meet at a corner have the same number there,
  // and the same irradiance.
  const std::array<int32_t, 3>& corner_numbers(NodeId leaf) const {
    return corner_[number_of_leaf_[leaf]];
  }

  // Irradiance at the point (u,v) of the root triangle of the leaf's surface, inside that leaf.
  void at(NodeId leaf, double u, double v, double* out) const;

 private:
  const Forest& forest_;
  int bands_;
  std::vector<int32_t> number_of_leaf_;         // per node, -1: not a leaf
  std::vector<std::array<int32_t, 3>> corner_;  // per leaf: the numbers of its corners
  std::vector<float> value_;                    // per corner: bands values
};

}  // namespace hrad
