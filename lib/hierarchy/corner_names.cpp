// Welding vertices, joining surfaces, numbering edges. Floor 5 (hierarchy).
#include "hierarchy/corner_names.h"

#include <algorithm>
#include <utility>

#include "base/hash.h"
#include "base/number_table.h"

namespace hrad {
namespace {

// Cosine of the angle between facets of a curved surface, at the least: 20 degrees, so that
// eighteen make a cylinder.
constexpr double least_cosine_of_facets = 0.9396;

uint64_t hash_of(Vec3 position) {
  Hasher hasher;
  for (double x : {position.x, position.y, position.z}) hasher.add(x);
  return hasher.value() >> 1;
}

// Per vertex of the scene the lowest vertex at the same position.
std::vector<int32_t> weld(const std::vector<Vec3>& vertices) {
  std::vector<int32_t> welded(vertices.size());
  NumberTable first_at;
  first_at.make_room(vertices.size());
  for (size_t k = 0; k < vertices.size(); ++k) {
    const Vec3& here = vertices[k];
    const auto is_elsewhere = [&](int32_t other) {
      const Vec3& there = vertices[static_cast<size_t>(other)];
      return there.x != here.x || there.y != here.y || there.z != here.z;
    };
    uint64_t key = hash_of(here);
    int32_t* first = &first_at.at(key);
    while (*first != NumberTable::none && is_elsewhere(*first))
      first = &first_at.at(key = mix(key) >> 1);
    if (*first == NumberTable::none) *first = static_cast<int32_t>(k);
    welded[k] = *first;
  }
  return welded;
}

uint64_t named(int32_t upper, int32_t lower) {
  return static_cast<uint64_t>(upper) << 32 | static_cast<uint32_t>(lower);
}

int32_t find_root(std::vector<int32_t>& parent, int32_t k) {
  while (parent[k] != k) k = parent[k] = parent[parent[k]];
  return k;
}

}  // namespace

CornerNames::CornerNames(const Forest& forest, double facet_area) {
  const Scene& scene = *forest.scene;
  const std::vector<int32_t> welded = weld(scene.vertices);
  const int32_t surfaces = static_cast<int32_t>(forest.surface_count());
  plane_.resize(surfaces);
  vertex_.resize(static_cast<size_t>(surfaces) * 3);
  edge_.resize(static_cast<size_t>(surfaces) * 3);
  NumberTable edges;
  edges.make_room(edge_.size() / 2);
  std::vector<uint32_t> first(1, 0);  // per edge and one more: of the surfaces that have it
  for (int32_t s = 0; s < surfaces; ++s) {
    plane_[s] = s;
    auto corners = scene.corners[forest.surfaces[s].patch];
    if (forest.surfaces[s].side) std::swap(corners[1], corners[2]);
    for (int k = 0; k < 3; ++k) vertex_[3 * s + k] = welded[corners[k]];
    for (int k = 0; k < 3; ++k) {
      const int32_t a = vertex_[3 * s + k], b = vertex_[3 * s + (k + 1) % 3];
      int32_t& edge = edges.at(named(std::min(a, b), std::max(a, b)));
      if (edge == NumberTable::none) {
        edge = static_cast<int32_t>(first.size()) - 1;
        first.push_back(0);
      }
      edge_[3 * s + k] = edge;
      ++first[static_cast<size_t>(edge) + 1];
    }
  }
  for (size_t edge = 1; edge < first.size(); ++edge) first[edge] += first[edge - 1];
  std::vector<uint32_t> next(first.begin(), first.end() - 1);
  std::vector<int32_t> having(edge_.size());
  for (size_t k = 0; k < edge_.size(); ++k)
    having[next[static_cast<size_t>(edge_[k])]++] = static_cast<int32_t>(k / 3);
  const auto runs_up = [&](int32_t s, size_t edge) {
    int k = 0;
    while (edge_[3 * s + k] != static_cast<int32_t>(edge)) ++k;
    return vertex_[3 * s + k] < vertex_[3 * s + (k + 1) % 3];
  };
  for (size_t edge = 0; edge + 1 < first.size(); ++edge)
    for (uint32_t a = first[edge]; a < first[edge + 1]; ++a)
      for (uint32_t b = a + 1; b < std::min(first[edge + 1], a + 8); ++b) {
        const int32_t x = having[a], y = having[b];
        const Surface &one = forest.surfaces[x], &other = forest.surfaces[y];
        // The two sides of a fold run along their edge in the same direction.
        const bool facets = one.area <= facet_area && other.area <= facet_area &&
                            dot(one.normal, other.normal) >= least_cosine_of_facets &&
                            runs_up(x, edge) != runs_up(y, edge);
        if (!facets && !share_plane(one, other)) continue;
        const int32_t p = find_root(plane_, x), q = find_root(plane_, y);
        plane_[std::max(p, q)] = std::min(p, q);
      }
  for (int32_t s = 0; s < surfaces; ++s) plane_[s] = find_root(plane_, s);
}

uint64_t CornerNames::name(int32_t surface, LatticePoint p) const {
  // Within a patch both coordinates are smaller: these bits are free.
  constexpr int32_t of_an_edge = lattice_size;
  constexpr uint64_t of_a_vertex = uint64_t{lattice_size} << 16;
  const int32_t rest = lattice_size - p.i - p.j;
  // Weights of the three root corners; two zeros: a vertex, one: on an edge, none: inside.
  const int32_t weight[3] = {rest, p.i, p.j};
  const int zeros = (rest == 0) + (p.i == 0) + (p.j == 0);
  if (zeros == 0) return named(surface, p.i << 16 | p.j);
  int first = 0;
  while (weight[first] == 0) ++first;
  const int32_t* vertex = &vertex_[3 * static_cast<size_t>(surface)];
  if (zeros == 2) return named(vertex[first], 0) | of_a_vertex;
  int second = first + 1;
  while (weight[second] == 0) ++second;
  const int32_t edge = edge_[3 * static_cast<size_t>(surface) + (second == first + 1 ? first : 2)];
  if (vertex[first] > vertex[second]) std::swap(first, second);
  return named(edge, of_an_edge | weight[second]);
}

}  // namespace hrad
