// Linear reconstruction: irradiance at every point from values at the corners of elements, so that
// pictures and point queries show no steps between them. Floor 8 (solver).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/linear_field.h"
#include "stages/exchange.h"
#include "stages/light_of_all.h"
#include "stages/state.h"

namespace hrad {

class Reconstruction {
 public:
  // cell_area: of rows, what their cells are no larger than. Collective.
  Reconstruction(State& state, const std::vector<NodeId>& leaves, const Exchange& exchange,
                 ThreadTeam& team, double cell_area);

  // Irradiance at the three corners of a leaf, in the order of Forest::triangle: 3*bands values.
  void corners(NodeId leaf, double* out) const { field_.corners(leaf, out); }

  // The numbers of its corners: leaves of one plane that meet at a corner have the same number
  // there, and the same irradiance.
  const std::array<int32_t, 3>& corner_numbers(NodeId leaf) const {
    return field_.corner_numbers(leaf);
  }

  // Irradiance at the point (u,v) of the root triangle of the leaf's surface, inside that leaf.
  void at(NodeId leaf, double u, double v, double* out) const;

 private:
  int bands_;
  LinearField field_;
};

}  // namespace hrad
