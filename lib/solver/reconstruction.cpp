// Corner values: weighted means, then the edges with hanging corners. Floor 8 (solver).
#include "solver/reconstruction.h"

#include <algorithm>
#include <cmath>

#include "solver/corner_index.h"
#include "stages/gather.h"

namespace hrad {
namespace {

// Sets the corners that hang within the edge from a to b to the edge's own values.
void straighten(const CornerIndex& index, int32_t surface, LatticePoint a, LatticePoint b,
                int bands, std::vector<float>& value) {
  if (((a.i + b.i) | (a.j + b.j)) & 1) return;
  const LatticePoint middle{(a.i + b.i) / 2, (a.j + b.j) / 2};
  const int32_t hanging = index.find(surface, middle);
  if (hanging < 0) return;
  const size_t from = static_cast<size_t>(index.find(surface, a)) * bands;
  const size_t to = static_cast<size_t>(index.find(surface, b)) * bands;
  for (int k = 0; k < bands; ++k)
    value[static_cast<size_t>(hanging) * bands + k] = (value[from + k] + value[to + k]) / 2;
  straighten(index, surface, a, middle, bands, value);
  straighten(index, surface, middle, b, bands, value);
}

constexpr int most_bands = 16;

// Irradiance that arrives evenly over a cell or leaf; the mean of a small one says more about its
// corner than that of a large one, whose middle is farther away.
double even_light(const State& state, NodeId id, double* values) {
  const Node& node = state.forest.nodes[id];
  if (state.cells.empty()) {
    const float* irradiance = &state.irradiance[static_cast<size_t>(id) * state.bands];
    std::copy(irradiance, irradiance + state.bands, values);
  } else {
    float by_row[most_bands];
    gather_links(state, id, by_row);
    std::copy(by_row, by_row + state.bands, values);
  }
  return node.exposed / std::sqrt(state.forest.area(node));
}

// Irradiance at a corner. A sealed one has none of its own and takes what the others have.
double direct_light(const State& state, const std::vector<float>& at_corners, NodeId leaf,
                    int corner, double* values) {
  const CornerLight& direct = state.direct;
  const int32_t number = direct.of_leaf[leaf][corner];
  for (int b = 0; b < state.bands; ++b) {
    const double mean = mean_of_corners(direct, at_corners, leaf, b, state.bands);
    values[b] = number >= 0 ? at_corners[static_cast<size_t>(number) * state.bands + b] : mean;
    // On from what is known half way.
    if (state.forest.nodes[leaf].half_way)
      values[b] = std::max(0.0, std::min(2 * mean, 2 * values[b] - mean));
  }
  return number >= 0 ? 1 : state.forest.nodes[leaf].exposed > 0 ? 1e-6 : 1e-12;
}

}  // namespace

LinearField::LinearField(const Forest& forest, int bands, const std::vector<NodeId>& elements,
                         const Value& value_of)
    : forest_(forest), bands_(bands), number_of_element_(forest.nodes.size(), -1) {
  CornerIndex index(forest);
  corner_.resize(elements.size());
  for (size_t k = 0; k < elements.size(); ++k) {
    const Node& element = forest.nodes[elements[k]];
    number_of_element_[elements[k]] = static_cast<int32_t>(k);
    LatticePoint corner[3];
    lattice_corners(element, corner);
    for (int c = 0; c < 3; ++c) corner_[k][c] = index.number(element.surface, corner[c]);
  }
  const size_t corners = static_cast<size_t>(index.count());
  std::vector<double> sum(corners * bands, 0.0), weight(corners, 0.0);
  double values[most_bands];
  for (size_t k = 0; k < elements.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      const double share = value_of(elements[k], c, values);
      const size_t at = static_cast<size_t>(corner_[k][c]);
      weight[at] += share;
      for (int b = 0; b < bands; ++b) sum[at * bands + b] += share * values[b];
    }
  value_.resize(corners * bands);
  for (size_t c = 0; c < corners; ++c)
    for (int b = 0; b < bands; ++b)
      value_[c * bands + b] =
          static_cast<float>(weight[c] > 0 ? sum[c * bands + b] / weight[c] : 0.0);

  // From the longest edges to the shortest: the ends of an edge are settled before what hangs in
  // it.
  std::vector<int32_t> order(elements.size());
  for (size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int32_t>(k);
  std::stable_sort(order.begin(), order.end(), [&](int32_t a, int32_t b) {
    return forest.nodes[elements[a]].level < forest.nodes[elements[b]].level;
  });
  for (int32_t k : order) {
    const Node& element = forest.nodes[elements[k]];
    LatticePoint corner[3];
    lattice_corners(element, corner);
    for (int c = 0; c < 3; ++c)
      straighten(index, element.surface, corner[c], corner[(c + 1) % 3], bands, value_);
  }
}

void LinearField::corners(NodeId element, double* out) const {
  const auto& corner = corner_numbers(element);
  for (int c = 0; c < 3; ++c)
    for (int b = 0; b < bands_; ++b)
      out[c * bands_ + b] = value_[static_cast<size_t>(corner[c]) * bands_ + b];
}

void LinearField::add_at(NodeId element, double u, double v, double* out) const {
  double x, y;
  element_coordinates(forest_.nodes[element], u, v, &x, &y);
  const auto& corner = corner_numbers(element);
  const double weight[3] = {1 - x - y, x, y};
  for (int b = 0; b < bands_; ++b)
    for (int c = 0; c < 3; ++c)
      out[b] += weight[c] * value_[static_cast<size_t>(corner[c]) * bands_ + b];
}

namespace {

// Light that arrives evenly over cells is made linear on these first, then taken at the corners of
// the leaves.
LinearField field_of(const State& state, const std::vector<NodeId>& leaves) {
  const Forest& forest = state.forest;
  const size_t bands = static_cast<size_t>(state.bands);
  std::vector<float> at_corners(state.direct.corner_count() * bands);
  for (size_t k = 0; k < state.direct.corner_count(); ++k)
    gather_corner(state, k, &at_corners[k * bands]);
  const auto even = [&](NodeId id, int, double* values) { return even_light(state, id, values); };
  if (state.cells.empty()) return LinearField(forest, state.bands, leaves, even);
  const LinearField on_cells(forest, state.bands, state.cells, even);
  return LinearField(forest, state.bands, leaves, [&](NodeId leaf, int c, double* values) {
    const double weight = direct_light(state, at_corners, leaf, c, values);
    NodeId cell = leaf;
    while (!on_cells.has(cell)) cell = forest.nodes[cell].parent;
    LatticePoint corner[3];
    lattice_corners(forest.nodes[leaf], corner);
    on_cells.add_at(cell, static_cast<double>(corner[c].i) / lattice_size,
                    static_cast<double>(corner[c].j) / lattice_size, values);
    return weight;
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
