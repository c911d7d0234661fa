// A scene: patches (the input triangles), their materials, and what was found doubtful in them.
// Floor 3 (scene).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/vec3.h"

namespace hrad {

struct Material {
  std::string name;
  std::vector<double> reflectance, emission;  // bands values each
  bool two_sided = false;
  bool blocker = false;  // blocks light, exchanges none
};

constexpr int most_bands = 16;

enum PatchFlags : uint8_t { patch_dropped = 1, patch_two_sided = 2, patch_blocker = 4 };

struct Scene {
  int bands = 3;
  bool z_up = false;  // stands upright along z; y is up otherwise, or nothing is known
  std::vector<Vec3> vertices;
  std::vector<Material> materials;
  // Per patch:
  std::vector<std::array<int32_t, 3>> corners;  // indices of vertices
  std::vector<int32_t> material;
  std::vector<int64_t> face;        // number of the OBJ face, from 0; else the patch's own number
  std::vector<uint8_t> flags;       // PatchFlags
  std::vector<double> emission;     // bands values each; those of the material until set apart
  std::vector<double> reflectance;  // likewise
  std::vector<std::string> diagnostics;  // one sentence each

  int64_t patch_count() const { return static_cast<int64_t>(corners.size()); }
  bool has(int64_t patch, PatchFlags flag) const { return (flags[patch] & flag) != 0; }
  // Takes part: neither dropped nor a blocker.
  bool exchanges(int64_t patch) const {
    return !has(patch, patch_dropped) && !has(patch, patch_blocker);
  }
  // In any band, whether it takes part or not.
  bool emits(int64_t patch) const;
  Triangle triangle(int64_t patch) const {
    const std::array<int32_t, 3>& c = corners[patch];
    return {vertices[c[0]], vertices[c[1]], vertices[c[2]]};
  }

  // Adds a material; missing values are 0.5 (reflectance) and 0 (emission).
  int32_t add_material(Material m);
  int32_t add_vertex(Vec3 v);
  // face < 0: the patch's own number.
  void add_patch(int32_t a, int32_t b, int32_t c, int32_t material_number,
                 int64_t face_number = -1);
  Box bounds() const;
  int64_t bytes() const;  // of its arrays
};

}  // namespace hrad
