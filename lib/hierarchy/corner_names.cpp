// Welding vertices, joining coplanar surfaces, numbering edges. Floor 5 (hierarchy).
#include "hierarchy/corner_names.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace hrad {
namespace {

// Per vertex of the scene the lowest vertex at the same position.
std::vector<int32_t> weld(const std::vector<Vec3>& vertices) {
  std::vector<int32_t> order(vertices.size()), welded(vertices.size());
  for (size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int32_t>(k);
  const auto position = [&](int32_t k) {
    return std::make_tuple(vertices[k].x, vertices[k].y, vertices[k].z);
  };
  std::sort(order.begin(), order.end(), [&](int32_t a, int32_t b) {
    const auto pa = position(a), pb = position(b);
    return pa != pb ? pa < pb : a < b;
  });
  for (size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && position(order[k]) == position(order[k - 1]);
    welded[order[k]] = same ? welded[order[k - 1]] : order[k];
  }
  return welded;
}

int32_t find_root(std::vector<int32_t>& parent, int32_t k) {
  while (parent[k] != k) k = parent[k] = parent[parent[k]];
  return k;
}

}  // namespace

CornerNames::CornerNames(const Forest& forest) {
  const Scene& scene = *forest.scene;
  const std::vector<int32_t> welded = weld(scene.vertices);
  const int32_t surfaces = static_cast<int32_t>(forest.surface_count());
  plane_.resize(surfaces);
  vertex_.resize(static_cast<size_t>(surfaces) * 3);
  edge_.resize(static_cast<size_t>(surfaces) * 3);
  struct Edge {
    int32_t low, high, surface, corner;
    bool operator<(const Edge& o) const {
      return std::tie(low, high, surface, corner) < std::tie(o.low, o.high, o.surface, o.corner);
    }
  };
  std::vector<Edge> edges;
  for (int32_t s = 0; s < surfaces; ++s) {
    plane_[s] = s;
    auto corners = scene.corners[forest.surfaces[s].patch];
    if (forest.surfaces[s].side) std::swap(corners[1], corners[2]);
    for (int k = 0; k < 3; ++k) vertex_[3 * s + k] = welded[corners[k]];
    for (int k = 0; k < 3; ++k) {
      const int32_t a = vertex_[3 * s + k], b = vertex_[3 * s + (k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), s, k});
    }
  }
  std::sort(edges.begin(), edges.end());
  for (size_t first = 0; first < edges.size();) {
    size_t end = first + 1;
    while (end < edges.size() && edges[end].low == edges[first].low &&
           edges[end].high == edges[first].high)
      ++end;
    for (size_t a = first; a < end; ++a)
      edge_[3 * edges[a].surface + edges[a].corner] = static_cast<int32_t>(first);
    for (size_t a = first; a < end; ++a)
      for (size_t b = a + 1; b < std::min(end, a + 8); ++b) {
        const Surface &x = forest.surfaces[edges[a].surface],
                      &y = forest.surfaces[edges[b].surface];
        if (!share_plane(x, y)) continue;
        const int32_t p = find_root(plane_, edges[a].surface),
                      q = find_root(plane_, edges[b].surface);
        plane_[std::max(p, q)] = std::min(p, q);
      }
    first = end;
  }
  for (int32_t s = 0; s < surfaces; ++s) plane_[s] = find_root(plane_, s);
}

uint64_t CornerNames::name(int32_t surface, LatticePoint p) const {
  const auto named = [](int32_t upper, int32_t lower) {
    return static_cast<uint64_t>(upper) << 32 | static_cast<uint32_t>(lower);
  };
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
