// Lowest and highest row at every corner. Floor 7 (stages).
#include "stages/cell_contrast.h"

#include <algorithm>
#include <array>

#include "hierarchy/corner_index.h"
#include "stages/exchange.h"

namespace hrad {
namespace {

// Root mean square over a cell of what a step within it leaves, as a share of its height.
constexpr float error_of_a_step = 0.25f;

float light_of_row(const State& state, const Brightness& brightness, NodeId cell) {
  double sum = 0;
  for (const Link& link : state.links[cell].links())
    sum += static_cast<double>(link.weight) * brightness.of_node[link.source];
  return static_cast<float>(sum);
}

}  // namespace

std::vector<float> contrast_of_cells(const State& state, const Brightness& brightness,
                                     const Exchange& exchange) {
  const Forest& forest = state.forest;
  std::vector<float> light(state.cells.size(), 0.0f);
  for (size_t k = 0; k < light.size(); ++k)
    if (exchange.mine(forest.nodes[state.cells[k]].surface))
      light[k] = light_of_row(state, brightness, state.cells[k]);
  exchange.share(light, [&](size_t k) { return forest.nodes[state.cells[k]].surface; });
  CornerIndex index(forest);
  struct Range {
    float low = 1e30f, high = -1e30f;
  };
  std::vector<Range> at_corner;
  // A larger cell has the corners of smaller neighbours in the middles of its edges.
  std::vector<std::array<int32_t, 6>> touched(state.cells.size());
  for (size_t k = 0; k < touched.size(); ++k) {
    const Node& node = forest.nodes[state.cells[k]];
    LatticePoint corner[3];
    lattice_corners(node, corner);
    for (int c = 0; c < 3; ++c) {
      touched[k][c] = index.number(node.surface, corner[c]);
      touched[k][3 + c] = index.number(node.surface, middle(corner[c], corner[(c + 1) % 3]));
    }
    at_corner.resize(static_cast<size_t>(index.count()));
    if (!(node.exposed > 0)) continue;
    for (int32_t number : touched[k]) {
      Range& range = at_corner[number];
      range.low = std::min(range.low, light[k]);
      range.high = std::max(range.high, light[k]);
    }
  }
  std::vector<float> contrast(touched.size(), 0.0f);
  for (size_t k = 0; k < contrast.size(); ++k) {
    if (!(forest.nodes[state.cells[k]].exposed > 0)) continue;
    for (int32_t number : touched[k]) {
      const Range& range = at_corner[number];
      contrast[k] = std::max(contrast[k], error_of_a_step * (range.high - range.low));
    }
  }
  return contrast;
}

}  // namespace hrad
