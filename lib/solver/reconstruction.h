// Linear reconstruction: irradiance at every point from values at the corners of elements, so that
// pictures and point queries show no steps between them. Floor 8 (solver).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "stages/state.h"

namespace hrad {

// A field that is linear on each element of a cut through the forest. Elements meet at a corner
// within one surface and across the edges it shares with surfaces of the same plane. The value at a
// corner that lies within a longer edge of a neighbour is that edge's own, so that no cracks open.
class LinearField {
 public:
  // What an element says about one of its corners: `bands` values, and how much they weigh.
  using Value = std::function<double(NodeId element, int corner, double* values)>;
  LinearField(const Forest& forest, int bands, const std::vector<NodeId>& elements,
              const Value& value);

  bool has(NodeId element) const { return number_of_element_[element] >= 0; }
  // At the three corners of an element, in the order of Forest::triangle: 3*bands values.
  void corners(NodeId element, double* out) const;
  const std::array<int32_t, 3>& corner_numbers(NodeId element) const {
    return corner_[number_of_element_[element]];
  }
  // Adds the value at the point (u,v) of the root triangle, inside that element.
  void add_at(NodeId element, double u, double v, double* out) const;

 private:
  const Forest& forest_;
  int bands_;
  std::vector<int32_t> number_of_element_;      // per node, -1: not in the cut
  std::vector<std::array<int32_t, 3>> corner_;  // per element: the numbers of its corners
  std::vector<float> value_;                    // per corner: bands values
};

class Reconstruction {
 public:
  Reconstruction(const State& state, const std::vector<NodeId>& leaves);

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
