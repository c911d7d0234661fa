// Corner values: weighted means, the means of elements, the edges with hanging corners.
// Floor 8 (solver).
#include "solver/linear_field.h"

#include <algorithm>

namespace hrad {
namespace {

// Times that corners are moved: after two the rest is noise.
constexpr int passes = 2;
constexpr double least_one_sidedness = 1e-6;  // less is rounding
// How far a corner may lie below or above all that its elements say.
constexpr float beyond = 0.5f;

// Sets the corners that hang within the edge from a to b to the edge's own values.
void straighten(const CornerIndex& index, int32_t surface, LatticePoint a, LatticePoint b,
                int bands, std::vector<float>& value) {
  if (((a.i + b.i) | (a.j + b.j)) & 1) return;
  const LatticePoint between = middle(a, b);
  const int32_t hanging = index.find(surface, between);
  if (hanging < 0) return;
  const size_t from = static_cast<size_t>(index.find(surface, a)) * bands;
  const size_t to = static_cast<size_t>(index.find(surface, b)) * bands;
  for (int k = 0; k < bands; ++k)
    value[static_cast<size_t>(hanging) * bands + k] = (value[from + k] + value[to + k]) / 2;
  straighten(index, surface, a, between, bands, value);
  straighten(index, surface, between, b, bands, value);
}

}  // namespace

LinearField::LinearField(const Forest& forest, int bands, const std::vector<NodeId>& elements,
                         Known known, const Value& value, const Mean& mean, double facet_area)
    : forest_(forest),
      bands_(static_cast<size_t>(bands)),
      number_of_element_(forest.nodes.size(), -1) {
  CornerIndex index(forest, facet_area);
  name_corners(elements, index);
  value_.assign(static_cast<size_t>(index.count()) * bands_, 0.0f);
  average(elements, value);
  close_cracks(elements, index);
  const size_t corners = static_cast<size_t>(index.count());
  keep_means(
      elements, mean,
      known == Known::at_corners ? std::vector<float>(corners, 1.0f) : one_sidedness(elements),
      index);
}

// Per corner: how far its elements lie to one side of it, 0 where they lie all round, 1 at the
// most.
std::vector<float> LinearField::one_sidedness(const std::vector<NodeId>& elements) const {
  const size_t corners = value_.size() / bands_;
  std::vector<Vec3> sum(corners, Vec3{0, 0, 0});
  std::vector<double> length_of_all(corners, 0.0);
  for (size_t k = 0; k < elements.size(); ++k) {
    const Triangle t = forest_.triangle(forest_.nodes[elements[k]]);
    const Vec3 centroid = t.centroid(), corner[3] = {t.a, t.b, t.c};
    for (int c = 0; c < 3; ++c) {
      const size_t at = static_cast<size_t>(corner_[k][c]);
      sum[at] = sum[at] + (centroid - corner[c]);
      length_of_all[at] += length(centroid - corner[c]);
    }
  }
  std::vector<float> result(corners, 0.0f);
  for (size_t k = 0; k < corners; ++k)
    if (length_of_all[k] > 0) {
      const double share = length(sum[k]) / length_of_all[k];
      result[k] = share > least_one_sidedness ? static_cast<float>(share) : 0.0f;
    }
  return result;
}

void LinearField::name_corners(const std::vector<NodeId>& elements, CornerIndex& index) {
  corner_.resize(elements.size());
  for (size_t k = 0; k < elements.size(); ++k) {
    const Node& element = forest_.nodes[elements[k]];
    number_of_element_[elements[k]] = static_cast<int32_t>(k);
    LatticePoint corner[3];
    lattice_corners(element, corner);
    for (int c = 0; c < 3; ++c) corner_[k][c] = index.number(element.surface, corner[c]);
  }
}

void LinearField::average(const std::vector<NodeId>& elements, const Value& value) {
  const size_t corners = value_.size() / bands_;
  std::vector<double> sum(value_.size(), 0.0), weight(corners, 0.0);
  double values[most_bands];
  for (size_t k = 0; k < elements.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      const double share = value(elements[k], c, values);
      const size_t at = static_cast<size_t>(corner_[k][c]);
      weight[at] += share;
      for (size_t b = 0; b < bands_; ++b) sum[at * bands_ + b] += share * values[b];
    }
  for (size_t k = 0; k < value_.size(); ++k)
    if (weight[k / bands_] > 0) value_[k] = static_cast<float>(sum[k] / weight[k / bands_]);
}

void LinearField::keep_means(const std::vector<NodeId>& elements, const Mean& mean,
                             const std::vector<float>& freedom, const CornerIndex& index) {
  const size_t corners = value_.size() / bands_;
  std::vector<float> wanted(elements.size() * bands_), share(elements.size());
  std::vector<double> weight(corners, 0.0);
  // Noise must not make rings around an element that is by far the brightest or the darkest.
  std::vector<float> low = value_, high = value_;
  double values[most_bands];
  for (size_t k = 0; k < elements.size(); ++k) {
    share[k] = static_cast<float>(mean(elements[k], values));
    for (size_t b = 0; b < bands_; ++b) wanted[k * bands_ + b] = static_cast<float>(values[b]);
    for (int32_t corner : corner_[k]) {
      weight[corner] += share[k];
      for (size_t b = 0; b < bands_ && share[k] > 0; ++b) {
        const size_t at = static_cast<size_t>(corner) * bands_ + b;
        low[at] = std::min(low[at], wanted[k * bands_ + b]);
        high[at] = std::max(high[at], wanted[k * bands_ + b]);
      }
    }
  }
  std::vector<double> sum(value_.size());
  for (int pass = 0; pass < passes; ++pass) {
    std::fill(sum.begin(), sum.end(), 0.0);
    for (size_t k = 0; k < elements.size(); ++k)
      for (size_t b = 0; b < bands_; ++b) {
        double missing = wanted[k * bands_ + b];
        for (int32_t corner : corner_[k])
          missing -= value_[static_cast<size_t>(corner) * bands_ + b] / 3.0;
        for (int32_t corner : corner_[k])
          sum[static_cast<size_t>(corner) * bands_ + b] += share[k] * missing;
      }
    for (size_t corner = 0; corner < weight.size(); ++corner)
      for (size_t b = 0; b < bands_ && weight[corner] > 0; ++b) {
        const size_t at = corner * bands_ + b;
        const double better = value_[at] + freedom[corner] * sum[at] / weight[corner];
        value_[at] = std::max(low[at] * (1 - beyond),
                              std::min(high[at] * (1 + beyond), static_cast<float>(better)));
      }
    close_cracks(elements, index);
  }
}

// From the longest edges to the shortest: the ends of an edge are settled before what hangs in it.
void LinearField::close_cracks(const std::vector<NodeId>& elements, const CornerIndex& index) {
  for (int level = 0; level <= max_level; ++level)
    for (NodeId id : elements) {
      const Node& element = forest_.nodes[id];
      if (element.level != level) continue;
      LatticePoint corner[3];
      lattice_corners(element, corner);
      for (int c = 0; c < 3; ++c)
        straighten(index, element.surface, corner[c], corner[(c + 1) % 3], static_cast<int>(bands_),
                   value_);
    }
}

void LinearField::corners(NodeId element, double* out) const {
  const auto& corner = corner_numbers(element);
  for (size_t c = 0; c < 3; ++c)
    for (size_t b = 0; b < bands_; ++b)
      out[c * bands_ + b] = value_[static_cast<size_t>(corner[c]) * bands_ + b];
}

void LinearField::add_at(NodeId element, double u, double v, double* out) const {
  double x, y;
  element_coordinates(forest_.nodes[element], u, v, &x, &y);
  const auto& corner = corner_numbers(element);
  const double weight[3] = {1 - x - y, x, y};
  for (size_t b = 0; b < bands_; ++b)
    for (size_t c = 0; c < 3; ++c)
      out[b] += weight[c] * value_[static_cast<size_t>(corner[c]) * bands_ + b];
}

}  // namespace hrad
