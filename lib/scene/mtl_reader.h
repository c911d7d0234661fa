// Materials of MTL files: Kd (reflectance), Ke (emission), and the marks "# hrad: two-sided" and
// "# hrad: blocker", for which MTL has no statement. Floor 3 (scene).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hrad {

struct MtlMaterial {
  std::string name;
  std::array<double, 3> reflectance{0.5, 0.5, 0.5}, emission{0, 0, 0};
  bool has_reflectance = false;
  bool two_sided = false, blocker = false;  // marked so
};

// What all MTL files of a scene define together.
struct MtlLibrary {
  std::vector<MtlMaterial> materials;      // in order of definition
  std::map<std::string, int32_t> numbers;  // by name
  // What was repaired or ignored, with the first place of each.
  int64_t clamped = 0, textures = 0, repeated = 0, vanished = 0, unknown = 0;
  std::string first_clamped, first_texture, first_repeated, first_vanished, first_unknown;
  // Materials that transmit light (d, Tr) or shine (Ks): here they are opaque and diffuse.
  int64_t transparent = 0, specular = 0;
  std::string first_transparent, first_specular;
};

// Adds the materials of one MTL text; path is for messages. A name defined before keeps its first
// meaning. SCENE with file:line.
void read_mtl(const std::string& path, std::string_view text, MtlLibrary& library);

}  // namespace hrad
