// What cells and leaves say about their corners. Floor 8 (solver).
#include "solver/reconstruction.h"

#include <algorithm>
#include <cmath>

#include "stages/gather.h"

namespace hrad {
namespace {

// Direct light is known at points, and comes on top of what arrives evenly.
bool has_points(const State& state) { return !state.direct.of_leaf.empty(); }

// Irradiance that arrives evenly over a cell or leaf; the mean of a small one says more about its
// corner than that of a large one, whose middle is farther away.
double even_light(const State& state, NodeId id, double* values) {
  const Node& node = state.forest.nodes[id];
  if (!has_points(state)) {
    const float* irradiance = &state.irradiance[static_cast<size_t>(id) * state.bands];
    std::copy(irradiance, irradiance + state.bands, values);
  } else {
    float by_row[most_bands];
    gather_links(state, id, by_row);
    std::copy(by_row, by_row + state.bands, values);
  }
  return node.exposed / std::sqrt(state.forest.area(node));
}

// What a leaf with points of its own says about its corners weighs less than what others know.
constexpr double weight_of_own_points = 1e-3;

// Where the three points of its own lie in a leaf, nullptr: it has none.
const CornerLight::OwnPoint* own_points(const State& state, NodeId leaf) {
  if (state.forest.nodes[leaf].light_points != at_own_points) return nullptr;
  const CornerLight& direct = state.direct;
  const int32_t first = direct.of_leaf[leaf][0];
  const auto found = std::lower_bound(
      direct.own.begin(), direct.own.end(), first,
      [](const CornerLight::OwnPoint& p, int32_t number) { return p.number < number; });
  return found != direct.own.end() && found->number == first ? &*found : nullptr;
}

// Weights of the values at three points of a leaf, for the plane through them at a corner.
bool plane_weights(const CornerLight::OwnPoint* p, int corner, double weight[3]) {
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
  const auto& number = direct.of_leaf[leaf];
  if (number[0] < 0) {
    std::fill(values, values + state.bands, 0.0);
    return 1e-12;
  }
  const uint8_t points = state.forest.nodes[leaf].light_points;
  const CornerLight::OwnPoint* own = own_points(state, leaf);
  double weight[3] = {1.0 / 3, 1.0 / 3, 1.0 / 3};
  const bool plane = own && plane_weights(own, corner, weight);
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

// Light that arrives evenly over cells is made linear on these first, then taken at the corners of
// the leaves.
LinearField field_of(const State& state, const std::vector<NodeId>& leaves) {
  const Forest& forest = state.forest;
  const size_t bands = static_cast<size_t>(state.bands);
  std::vector<float> at_points(state.direct.point_count() * bands);
  for (size_t k = 0; k < state.direct.point_count(); ++k)
    gather_point(state, k, &at_points[k * bands]);
  const auto even = [&](NodeId id, double* values) { return even_light(state, id, values); };
  const auto even_at = [&](NodeId id, int, double* values) { return even(id, values); };
  if (!has_points(state))
    return LinearField(forest, state.bands, leaves, LinearField::Known::over_elements, even_at,
                       even);
  const LinearField on_cells(forest, state.bands, state.cells, LinearField::Known::over_elements,
                             even_at, even);
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
        const double weight = direct_light(state, at_points, leaf, c, values);
        add_from_cells(leaf, c, values);
        return weight;
      },
      [&](NodeId leaf, double* values) {
        std::fill(values, values + bands, 0.0);
        for (int c = 0; c < 3; ++c) add_from_cells(leaf, c, values);
        float direct[most_bands];
        gather_direct(state, leaf, direct);
        for (size_t b = 0; b < bands; ++b) values[b] = values[b] / 3 + direct[b];
        // The mean of a partly sealed leaf is not that of the three corners.
        return forest.nodes[leaf].exposed < 1 ? 0.0 : 1.0;
      });
}

}  // namespace

Reconstruction::Reconstruction(const State& state, const std::vector<NodeId>& leaves)
    : bands_(state.bands), field_(field_of(state, leaves)) {}

void Reconstruction::at(NodeId leaf, double u, double v, double* out) const {
  std::fill(out, out + bands_, 0.0);
  field_.add_at(leaf, u, v, out);
  for (int b = 0; b < bands_; ++b) out[b] = std::max(0.0, out[b]);
}

}  // namespace hrad
