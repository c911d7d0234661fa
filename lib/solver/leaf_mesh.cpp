// Sharing of vertices within one side of a patch. Floor 8 (solver).
#include "solver/leaf_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "base/error.h"
#include "solver/solver.h"

namespace hrad {
namespace {

// The largest value of a 32-bit index is kept free: some formats give it a meaning.
constexpr int64_t most_vertices = std::numeric_limits<uint32_t>::max();

// Of length 1 whatever the scale of the coordinates.
Vec3 unit_normal(const Triangle& triangle) {
  const Vec3 u = triangle.b - triangle.a, v = triangle.c - triangle.a;
  const auto longest = [](Vec3 e) {
    return std::max({std::fabs(e.x), std::fabs(e.y), std::fabs(e.z)});
  };
  return normalized(cross(u * (1 / longest(u)), v * (1 / longest(v))));
}

}  // namespace

LeafMesh::LeafMesh(const Solver& solver, const std::string& path) : solver_(solver), path_(path) {
  const int64_t leaves = solver.leaf_count();
  triangles_.resize(static_cast<size_t>(leaves));
  for (int64_t first = 0; first < leaves;) {
    const LeafView leaf = solver.leaf(first);
    int64_t end = first + 1;
    while (end < leaves && solver.leaf(end).patch == leaf.patch &&
           solver.leaf(end).side == leaf.side)
      ++end;
    add_side(first, end);
    first = end;
  }
}

void LeafMesh::add_side(int64_t first_leaf, int64_t end_leaf) {
  if (end_leaf - first_leaf == 1) {
    for (int corner = 0; corner < 3; ++corner)
      triangles_[first_leaf][corner] = new_vertex(first_leaf, corner);
    return;
  }
  // Sealed leaves have the radiosity of their emission alone.
  std::unordered_map<int32_t, uint32_t> met[2];
  for (int64_t leaf = first_leaf; leaf < end_leaf; ++leaf) {
    const std::array<int32_t, 3> names = solver_.leaf_corner_numbers(leaf);
    const bool sealed = solver_.leaf(leaf).exposed == 0;
    for (int corner = 0; corner < 3; ++corner) {
      const auto [found, is_new] = met[sealed].try_emplace(names[corner], 0);
      if (is_new) found->second = new_vertex(leaf, corner);
      triangles_[leaf][corner] = found->second;
    }
  }
}

uint32_t LeafMesh::new_vertex(int64_t leaf, int corner) {
  const int64_t number = vertex_count();
  if (number == most_vertices)
    fail(Status::unsupported,
         "%s: the solution has more than %lld vertices, which this format can't number: use .vtu "
         "or .csv",
         path_.c_str(), static_cast<long long>(most_vertices));
  first_use_.push_back(3 * leaf + corner);
  return static_cast<uint32_t>(number);
}

MeshVertex LeafMesh::vertex(int64_t number) const {
  const int64_t leaf = first_use_[number] / 3, corner = first_use_[number] % 3;
  const int bands = solver_.scene().bands;
  const LeafView view = solver_.leaf(leaf);
  // The patch's own normal: that of a small leaf would be rounded more.
  const Vec3 front = unit_normal(solver_.scene().triangle(view.patch));
  MeshVertex vertex;
  vertex.position = corner == 0 ? view.corners.a : corner == 1 ? view.corners.b : view.corners.c;
  vertex.normal = view.side == 0 ? front : -front;
  double radiosity[3 * 16];
  solver_.leaf_corner_radiosity(leaf, radiosity);
  std::copy_n(radiosity + corner * bands, bands, vertex.radiosity.begin());
  return vertex;
}

float finite_float(double value) {
  constexpr double most = std::numeric_limits<float>::max();
  return static_cast<float>(std::min(std::max(value, -most), most));
}

}  // namespace hrad
