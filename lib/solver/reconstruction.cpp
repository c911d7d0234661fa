// What cells and leaves say about their corners. Floor 8 (solver).
#include "solver/reconstruction.h"

#include <algorithm>
#include <cmath>

#include "solver/facet_light.h"
#include "stages/exchange.h"
#include "stages/gather.h"

namespace hrad {
namespace {

bool has_points(const State& state) { return !state.direct.of_leaf.empty(); }

// Of a cell, up to which patches are taken for facets, and their light is evened out.
constexpr double facets_of_a_cell = 1.0 / 16;

// What a leaf with points of its own says about its corners weighs less than what others know.
constexpr double weight_of_own_points = 1e-3;

// Weights of the values at three points of a leaf, for the plane through them at a corner.
bool plane_weights(const LeafPoints::Places& p, int corner, double weight[3]) {
  const double x = corner == 1, y = corner == 2;
  const double bx = p[1].x - p[0].x, by = p[1].y - p[0].y, cx = p[2].x - p[0].x,
               cy = p[2].y - p[0].y;
  const double determinant = bx * cy - by * cx;
  if (!(std::fabs(determinant) > 1e-6)) return false;
  weight[1] = ((x - p[0].x) * cy - (y - p[0].y) * cx) / determinant;
  weight[2] = ((y - p[0].y) * bx - (x - p[0].x) * by) / determinant;
  weight[0] = 1 - weight[1] - weight[2];
  return true;
}

// Irradiance at a corner, and how much it weighs.
double direct_light(const State& state, const std::vector<float>& at_points, NodeId leaf,
                    int corner, double* values) {
  const CornerLight& direct = state.direct;
  const LeafPoints::Numbers number = direct.of_leaf[static_cast<size_t>(leaf)];
  if (number[0] < 0) {
    std::fill(values, values + state.bands, 0.0);
    return 1e-12;
  }
  const uint8_t points = state.forest.nodes[leaf].light_points;
  const LeafPoints::Places* own = direct.of_leaf.own_places(static_cast<size_t>(leaf));
  double weight[3] = {1.0 / 3, 1.0 / 3, 1.0 / 3};
  const bool plane = own && plane_weights(*own, corner, weight);
  for (int b = 0; b < state.bands; ++b) {
    const auto at = [&](int c) {
      return static_cast<double>(at_points[static_cast<size_t>(number[c]) * state.bands + b]);
    };
    const double mean = (at(0) + at(1) + at(2)) / 3;
    if (own)
      values[b] = plane ? weight[0] * at(0) + weight[1] * at(1) + weight[2] * at(2) : mean;
    else if (points == half_way_to_the_middle)
      values[b] = 2 * at(corner) - mean;
    else
      values[b] = at(corner);
    values[b] = std::max(0.0, std::min(3 * mean, values[b]));
  }
  return own ? weight_of_own_points : 1;
}

// What is known of cells and leaves by links that their owners alone have, in the order of the
// cells and leaves.
struct LightByLinks {
  std::vector<float> of_cells;   // what arrives over rows, bands values
  std::vector<float> of_leaves;  // direct light: the mean, then at the three corners
  std::vector<float> weight;     // per leaf and corner
  LightByLinks(const State& state, const std::vector<NodeId>& leaves, const Exchange& exchange);
};

LightByLinks::LightByLinks(const State& state, const std::vector<NodeId>& leaves,
                           const Exchange& exchange) {
  const size_t bands = static_cast<size_t>(state.bands);
  const auto surface = [&](NodeId id) { return state.forest.nodes[id].surface; };
  of_cells.resize(state.cells.size() * bands);
  for (size_t k = 0; k < state.cells.size(); ++k)
    if (exchange.mine(surface(state.cells[k])))
      gather_links(state, state.cells[k], &of_cells[k * bands]);
  exchange.share_rows(of_cells, bands, [&](size_t k) { return surface(state.cells[k]); });
  std::vector<float> at_points(state.direct.point_count() * bands);
  for (size_t k = 0; k < state.direct.point_count(); ++k)
    gather_point(state, k, &at_points[k * bands]);
  of_leaves.resize(leaves.size() * 4 * bands);
  weight.resize(leaves.size() * 3);
  for (size_t k = 0; k < leaves.size(); ++k) {
    if (!exchange.mine(surface(leaves[k]))) continue;
    float* const out = &of_leaves[k * 4 * bands];
    gather_direct(state, leaves[k], out);
    for (size_t c = 0; c < 3; ++c) {
      double values[most_bands];
      weight[3 * k + c] = static_cast<float>(
          direct_light(state, at_points, leaves[k], static_cast<int>(c), values));
      for (size_t b = 0; b < bands; ++b) out[(c + 1) * bands + b] = static_cast<float>(values[b]);
    }
  }
  const auto of_leaf = [&](size_t k) { return surface(leaves[k]); };
  exchange.share_rows(of_leaves, 4 * bands, of_leaf);
  exchange.share_rows(weight, 3, of_leaf);
}

// The mean of a small one says more about its corner than that of a large one, whose middle is
// farther away.
double weight_of_mean(const Forest& forest, NodeId id) {
  return forest.nodes[id].exposed / std::sqrt(forest.area(forest.nodes[id]));
}

// From all that arrives over the leaves.
LinearField field_of_means(State& state, const std::vector<NodeId>& leaves,
                           const Exchange& exchange, ThreadTeam& team) {
  const LightOfAll irradiance(state, &State::irradiance, exchange, team);
  const auto mean = [&](NodeId id, double* values) {
    std::copy_n(irradiance[id], state.bands, values);
    return weight_of_mean(state.forest, id);
  };
  return LinearField(
      state.forest, state.bands, leaves, LinearField::Known::over_elements,
      [&](NodeId id, int, double* values) { return mean(id, values); }, mean);
}

std::vector<int32_t> places_of(const std::vector<NodeId>& ids, size_t nodes) {
  std::vector<int32_t> place(nodes, -1);
  for (size_t k = 0; k < ids.size(); ++k) place[ids[k]] = static_cast<int32_t>(k);
  return place;
}

// Light that arrives evenly over cells is made linear on these first, then taken at the corners of
// the leaves; direct light is known at points, and comes on top.
LinearField field_of_rows(const State& state, const std::vector<NodeId>& leaves,
                          const Exchange& exchange, double cell_area) {
  const Forest& forest = state.forest;
  const size_t bands = static_cast<size_t>(state.bands);
  LightByLinks light(state, leaves, exchange);
  const double facet_area = facets_of_a_cell * cell_area;
  even_out_facets(forest, state.bands, state.cells, facet_area, light.of_cells);
  const std::vector<int32_t> cell_at = places_of(state.cells, forest.nodes.size());
  const std::vector<int32_t> leaf_at = places_of(leaves, forest.nodes.size());
  const auto even = [&](NodeId id, double* values) {
    const float* by_row = &light.of_cells[static_cast<size_t>(cell_at[id]) * bands];
    std::copy(by_row, by_row + bands, values);
    return weight_of_mean(forest, id);
  };
  const LinearField on_cells(
      forest, state.bands, state.cells, LinearField::Known::over_elements,
      [&](NodeId id, int, double* values) { return even(id, values); }, even, facet_area);
  const auto add_from_cells = [&](NodeId leaf, int c, double* values) {
    NodeId cell = leaf;
    while (!on_cells.has(cell)) cell = forest.nodes[cell].parent;
    LatticePoint corner[3];
    lattice_corners(forest.nodes[leaf], corner);
    on_cells.add_at(cell, static_cast<double>(corner[c].i) / lattice_size,
                    static_cast<double>(corner[c].j) / lattice_size, values);
  };
  return LinearField(
      forest, state.bands, leaves, LinearField::Known::at_corners,
      [&](NodeId leaf, int c, double* values) {
        const size_t at = static_cast<size_t>(leaf_at[leaf]), corner = static_cast<size_t>(c);
        const float* direct = &light.of_leaves[(4 * at + corner + 1) * bands];
        std::copy(direct, direct + bands, values);
        add_from_cells(leaf, c, values);
        return static_cast<double>(light.weight[3 * at + corner]);
      },
      [&](NodeId leaf, double* values) {
        std::fill(values, values + bands, 0.0);
        for (int c = 0; c < 3; ++c) add_from_cells(leaf, c, values);
        const float* direct = &light.of_leaves[4 * static_cast<size_t>(leaf_at[leaf]) * bands];
        for (size_t b = 0; b < bands; ++b) values[b] = values[b] / 3 + direct[b];
        // The mean of a partly sealed leaf is not that of the three corners.
        return forest.nodes[leaf].exposed < 1 ? 0.0 : 1.0;
      });
}

}  // namespace

Reconstruction::Reconstruction(State& state, const std::vector<NodeId>& leaves,
                               const Exchange& exchange, ThreadTeam& team, double cell_area)
    : bands_(state.bands),
      field_(has_points(state) ? field_of_rows(state, leaves, exchange, cell_area)
                               : field_of_means(state, leaves, exchange, team)) {}

void Reconstruction::at(NodeId leaf, double u, double v, double* out) const {
  std::fill(out, out + bands_, 0.0);
  field_.add_at(leaf, u, v, out);
  for (int b = 0; b < bands_; ++b) out[b] = std::max(0.0, out[b]);
}

}  // namespace hrad
