// From facets to corners and back, until it has spread far enough. Floor 8 (solver).
#include "solver/facet_light.h"

#include <algorithm>
#include <array>

#include "hierarchy/corner_index.h"

namespace hrad {
namespace {

// In facets: what one pass reaches. A pass takes as much again.
constexpr double facets_of_a_pass = 6;
constexpr int most_passes = 32;

struct Facet {
  size_t cell;
  double area;  // exposed
  int passes;
  std::array<int32_t, 3> corner;
};

// Those that are worth a pass.
std::vector<Facet> facets_of(const Forest& forest, const std::vector<NodeId>& cells, double reach,
                             CornerIndex& index) {
  std::vector<Facet> facets;
  for (size_t k = 0; k < cells.size(); ++k) {
    const Node& node = forest.nodes[cells[k]];
    const double area = forest.area(node);
    if (node.level > 0 || !(node.exposed > 0) || facets_of_a_pass * area > reach) continue;
    Facet facet{k, area * node.exposed, most_passes, {}};
    if (most_passes * facets_of_a_pass * area > reach)
      facet.passes = static_cast<int>(reach / (facets_of_a_pass * area));
    LatticePoint corner[3];
    lattice_corners(node, corner);
    for (int c = 0; c < 3; ++c) facet.corner[c] = index.number(node.surface, corner[c]);
    facets.push_back(facet);
  }
  return facets;
}

}  // namespace

void even_out_facets(const Forest& forest, int bands, const std::vector<NodeId>& cells,
                     double reach, std::vector<float>& light) {
  CornerIndex index(forest, reach);
  std::vector<Facet> facets = facets_of(forest, cells, reach, index);
  const size_t corners = static_cast<size_t>(index.count()), width = static_cast<size_t>(bands);
  std::vector<double> sum(corners * width), area(corners);
  for (int pass = 0; pass < most_passes && !facets.empty(); ++pass) {
    std::fill(sum.begin(), sum.end(), 0.0);
    std::fill(area.begin(), area.end(), 0.0);
    for (const Facet& facet : facets)
      for (int32_t corner : facet.corner) {
        const size_t at = static_cast<size_t>(corner);
        area[at] += facet.area;
        for (size_t b = 0; b < width; ++b)
          sum[at * width + b] += facet.area * static_cast<double>(light[facet.cell * width + b]);
      }
    for (const Facet& facet : facets)
      for (size_t b = 0; b < width; ++b) {
        double mean = 0;
        for (int32_t corner : facet.corner) {
          const size_t at = static_cast<size_t>(corner);
          mean += sum[at * width + b] / (3 * area[at]);
        }
        light[facet.cell * width + b] = static_cast<float>(mean);
      }
    facets.erase(std::remove_if(facets.begin(), facets.end(),
                                [&](const Facet& f) { return f.passes <= pass + 1; }),
                 facets.end());
  }
}

}  // namespace hrad
