// Finds the closed solids of a scene: union-find over shared edges. Floor 3 (scene).
#include "scene/solids.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "scene/edge_fan.h"
#include "scene/weld.h"

namespace hrad {

namespace {

// Signed volume, relative to the cube of the largest extent, below which a component has no inside:
// a sheet of two coincident sides, with the rounding of its sum.
constexpr double volume_rounding = 1e-12;

// One side of one patch: from `low` to `high` or the other way.
struct Edge {
  int32_t low, high, patch;
  bool reversed;

  bool same_place(const Edge& other) const { return low == other.low && high == other.high; }
  bool operator<(const Edge& other) const {
    return std::tie(low, high, patch, reversed) <
           std::tie(other.low, other.high, other.patch, other.reversed);
  }
};

std::vector<Edge> sorted_edges(const Scene& scene, const std::vector<int32_t>& position) {
  std::vector<Edge> edges;
  edges.reserve(3 * scene.corners.size());
  for (int64_t i = 0; i < scene.patch_count(); ++i) {
    if (scene.has(i, patch_dropped)) continue;
    for (int k = 0; k < 3; ++k) {
      const int32_t from = position[scene.corners[i][k]];
      const int32_t to = position[scene.corners[i][(k + 1) % 3]];
      edges.push_back({std::min(from, to), std::max(from, to), static_cast<int32_t>(i), from > to});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

// Disjoint sets of patches; each is named by its lowest.
class Sets {
 public:
  explicit Sets(size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }

  int32_t find(int32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int32_t i, int32_t j) {
    i = find(i);
    j = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<int32_t> parent_;
};

// What the edges say: the sets of connected patches, and the patches at an edge that doesn't close.
struct Connection {
  Sets sets;
  std::vector<int32_t> open;
};

// The corner of a patch that lies off an edge.
Vec3 apex_of(const Scene& scene, const std::vector<int32_t>& position, const Edge& edge) {
  for (int32_t corner : scene.corners[edge.patch])
    if (position[corner] != edge.low && position[corner] != edge.high)
      return scene.vertices[corner];
  return {};  // not met: such a patch has no area
}

// A vertex of each position.
std::vector<int32_t> vertex_of_position(const std::vector<int32_t>& position) {
  std::vector<int32_t> vertex(position.size());
  for (size_t i = 0; i < position.size(); ++i) vertex[position[i]] = static_cast<int32_t>(i);
  return vertex;
}

// An edge of two patches in opposite directions joins them. At an edge of more, several solids (or
// one that touches itself) meet: those patches are joined that have solid between them. Any other
// edge is open and joins all its patches.
Connection connect(const Scene& scene) {
  const std::vector<int32_t> position = weld(scene.vertices);
  const std::vector<int32_t> vertex = vertex_of_position(position);
  const std::vector<Edge> edges = sorted_edges(scene, position);
  Connection result{Sets(scene.corners.size()), {}};
  std::vector<EdgePatch> around;
  std::vector<std::pair<int32_t, int32_t>> pairs;
  for (size_t begin = 0, end; begin < edges.size(); begin = end) {
    for (end = begin; end < edges.size() && edges[end].same_place(edges[begin]);) ++end;
    if (end - begin == 2 && edges[begin].reversed != edges[begin + 1].reversed) {
      result.sets.join(edges[begin].patch, edges[begin + 1].patch);
      continue;
    }
    around.clear();
    pairs.clear();
    for (size_t i = begin; i < end; ++i)
      around.push_back({apex_of(scene, position, edges[i]), edges[i].patch, edges[i].reversed});
    if (pair_around_edge(scene.vertices[vertex[edges[begin].low]],
                         scene.vertices[vertex[edges[begin].high]], around, pairs)) {
      for (const auto& [a, b] : pairs) result.sets.join(a, b);
      continue;
    }
    for (size_t i = begin; i < end; ++i) {
      result.sets.join(edges[begin].patch, edges[i].patch);
      result.open.push_back(edges[i].patch);
    }
  }
  return result;
}

}  // namespace

Solids find_solids(const Scene& scene) {
  Connection connection = connect(scene);
  Solids solids;
  const int64_t n = scene.patch_count();
  solids.component.assign(n, -1);
  for (int64_t i = 0; i < n; ++i) {
    if (scene.has(i, patch_dropped)) continue;
    const int32_t lowest = connection.sets.find(static_cast<int32_t>(i));
    if (lowest == i) {
      solids.component[i] = static_cast<int32_t>(solids.closed.size());
      solids.closed.push_back(1);
      solids.box.emplace_back();
    }
    const int32_t component = solids.component[i] = solids.component[lowest];
    if (scene.has(i, patch_two_sided)) solids.closed[component] = 0;
    for (int32_t corner : scene.corners[i]) solids.box[component].grow(scene.vertices[corner]);
  }
  for (int32_t patch : connection.open) solids.closed[solids.component[patch]] = 0;

  // Six times the volume between each patch and the middle of its component.
  solids.volume.assign(solids.closed.size(), 0.0);
  for (int64_t i = 0; i < n; ++i) {
    const int32_t component = solids.component[i];
    if (component < 0 || !solids.closed[component]) continue;
    const Vec3 center = solids.box[component].center();
    const Triangle t = scene.triangle(i);
    solids.volume[component] += dot(t.a - center, cross(t.b - center, t.c - center));
  }
  for (size_t c = 0; c < solids.volume.size(); ++c) {
    solids.volume[c] /= 6;
    const Vec3 extent = solids.box[c].extent();
    const double size = std::max({extent.x, extent.y, extent.z});
    if (std::fabs(solids.volume[c]) > volume_rounding * size * size * size) continue;
    solids.closed[c] = 0;
    solids.volume[c] = 0;
  }
  return solids;
}

}  // namespace hrad
