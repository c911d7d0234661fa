// Corner values: weighted means, then the edges with hanging corners. Floor 8 (solver).
#include "solver/reconstruction.h"

#include <algorithm>
#include <cmath>

#include "solver/corner_index.h"

namespace hrad {
namespace {

// Sets the corners that hang within the edge from a to b to the edge's own values.
void straighten(const CornerIndex& index, int32_t surface, LatticePoint a, LatticePoint b, int bands,
                std::vector<float>& value) {
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

}  // namespace

Reconstruction::Reconstruction(const Forest& forest, int bands, const std::vector<NodeId>& leaves,
                               const std::vector<float>& irradiance)
    : forest_(forest), bands_(bands), number_of_leaf_(forest.nodes.size(), -1) {
  CornerIndex index(forest);
  corner_.resize(leaves.size());
  for (size_t k = 0; k < leaves.size(); ++k) {
    const Node& leaf = forest.nodes[leaves[k]];
    number_of_leaf_[leaves[k]] = static_cast<int32_t>(k);
    LatticePoint corner[3];
    lattice_corners(leaf, corner);
    for (int c = 0; c < 3; ++c) corner_[k][c] = index.number(leaf.surface, corner[c]);
  }
  const size_t corners = static_cast<size_t>(index.count());
  std::vector<double> sum(corners * bands, 0.0), weight(corners, 0.0);
  for (size_t k = 0; k < leaves.size(); ++k) {
    const Node& leaf = forest.nodes[leaves[k]];
    // The mean of a small leaf says more about its corner than that of a large one, whose middle is
    // farther away: weights fall with the size.
    const double nearness = leaf.exposed / std::sqrt(forest.area(leaf));
    for (int32_t c : corner_[k]) {
      weight[c] += nearness;
      for (int b = 0; b < bands; ++b)
        sum[static_cast<size_t>(c) * bands + b] +=
            nearness * irradiance[static_cast<size_t>(leaves[k]) * bands + b];
    }
  }
  value_.resize(corners * bands);
  for (size_t c = 0; c < corners; ++c)
    for (int b = 0; b < bands; ++b)
      value_[c * bands + b] =
          static_cast<float>(weight[c] > 0 ? sum[c * bands + b] / weight[c] : 0.0);

  // From the longest edges to the shortest: the ends of an edge are settled before what hangs in it.
  std::vector<int32_t> order(leaves.size());
  for (size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int32_t>(k);
  std::stable_sort(order.begin(), order.end(), [&](int32_t a, int32_t b) {
    return forest.nodes[leaves[a]].level < forest.nodes[leaves[b]].level;
  });
  for (int32_t k : order) {
    const Node& leaf = forest.nodes[leaves[k]];
    LatticePoint corner[3];
    lattice_corners(leaf, corner);
    for (int c = 0; c < 3; ++c)
      straighten(index, leaf.surface, corner[c], corner[(c + 1) % 3], bands, value_);
  }
}

void Reconstruction::corners(NodeId leaf, double* out) const {
  const auto& corner = corner_[number_of_leaf_[leaf]];
  for (int c = 0; c < 3; ++c)
    for (int b = 0; b < bands_; ++b)
      out[c * bands_ + b] = value_[static_cast<size_t>(corner[c]) * bands_ + b];
}

void Reconstruction::at(NodeId leaf, double u, double v, double* out) const {
  const Node& n = forest_.nodes[leaf];
  const double scale = static_cast<double>(1 << n.level);
  double x = u * scale - n.i, y = v * scale - n.j;
  if (n.inverted) {
    x = 1 - x;
    y = 1 - y;
  }
  const auto& corner = corner_[number_of_leaf_[leaf]];
  const double weight[3] = {1 - x - y, x, y};
  for (int b = 0; b < bands_; ++b) {
    double value = 0;
    for (int c = 0; c < 3; ++c)
      value += weight[c] * value_[static_cast<size_t>(corner[c]) * bands_ + b];
    out[b] = std::max(0.0, value);
  }
}

}  // namespace hrad
