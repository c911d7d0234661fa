// A field that is linear on each element of a cut through the forest, without cracks.
// Floor 8 (solver).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "hierarchy/corner_index.h"

namespace hrad {

// Elements meet at a corner within one surface and across the edges it shares with surfaces of the
// same plane, or with facets of a curved surface. The value at a corner that lies within a longer
// edge of a neighbour is that edge's own, so that no cracks open.
class LinearField {
 public:
  // What an element says about one of its corners: `bands` values, and how much they weigh.
  using Value = std::function<double(NodeId element, int corner, double* values)>;
  // The mean that the field is to have over an element, and how much that weighs.
  using Mean = std::function<double(NodeId element, double* values)>;
  // Whether values are means over elements, so that a corner knows a slope only where it lies in
  // the middle of its elements, or belong to the corners themselves.
  enum class Known { over_elements, at_corners };
  // Corners get the weighted means of the values, then are moved until the means of the elements
  // are nearly those that are wanted; where values are known over elements, as far as these lie to
  // one side of the corner. facet_area: CornerNames'.
  LinearField(const Forest& forest, int bands, const std::vector<NodeId>& elements, Known known,
              const Value& value, const Mean& mean, double facet_area = 0);

  bool has(NodeId element) const { return number_of_element_[element] >= 0; }
  // At the three corners of an element, in the order of Forest::triangle: 3*bands values.
  void corners(NodeId element, double* out) const;
  const std::array<int32_t, 3>& corner_numbers(NodeId element) const {
    return corner_[number_of_element_[element]];
  }
  // Adds the value at the point (u,v) of the root triangle, inside that element.
  void add_at(NodeId element, double u, double v, double* out) const;

 private:
  void name_corners(const std::vector<NodeId>& elements, CornerIndex& index);
  void average(const std::vector<NodeId>& elements, const Value& value);
  std::vector<float> one_sidedness(const std::vector<NodeId>& elements) const;
  void keep_means(const std::vector<NodeId>& elements, const Mean& mean,
                  const std::vector<float>& freedom, const CornerIndex& index);
  void close_cracks(const std::vector<NodeId>& elements, const CornerIndex& index);

  const Forest& forest_;
  const size_t bands_;
  std::vector<int32_t> number_of_element_;      // per node, -1: not in the cut
  std::vector<std::array<int32_t, 3>> corner_;  // per element: the numbers of its corners
  std::vector<float> value_;                    // per corner: bands values
};

}  // namespace hrad
