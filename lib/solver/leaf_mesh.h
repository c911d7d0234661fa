// The leaves as an indexed triangle mesh, for formats that share vertices: triangle k is leaf k,
// and leaves of one side of a patch share the corners at which they meet in the same value. Patches
// keep vertices of their own, since normals and reflectances step at their edges. Floor 8 (solver).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/vec3.h"

namespace hrad {

class Solver;

struct MeshVertex {
  Vec3 position;
  Vec3 normal;                         // length 1, towards the leaf's side
  std::array<double, 16> radiosity{};  // linear reconstruction; the first `bands` values
};

class LeafMesh {
 public:
  // The solver must outlive the mesh. path: for the message when the vertices are more than 32-bit
  // indices can name (UNSUPPORTED). STATE before a solve.
  LeafMesh(const Solver& solver, const std::string& path);

  int64_t triangle_count() const { return static_cast<int64_t>(triangles_.size()); }
  int64_t vertex_count() const { return static_cast<int64_t>(first_use_.size()); }

  // Vertex numbers, anticlockwise seen from the leaf's side.
  const std::array<uint32_t, 3>& triangle(int64_t leaf) const { return triangles_[leaf]; }
  MeshVertex vertex(int64_t number) const;

 private:
  void add_side(int64_t first_leaf, int64_t end_leaf);
  uint32_t new_vertex(int64_t leaf, int corner);

  const Solver& solver_;
  const std::string path_;
  std::vector<std::array<uint32_t, 3>> triangles_;
  std::vector<int64_t> first_use_;  // per vertex: 3 * leaf + corner where it was met first
};

// The nearest float; the largest one for what is beyond, since mesh formats know no infinity.
float finite_float(double value);

}  // namespace hrad
