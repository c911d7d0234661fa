// What an OBJ text says, statement by statement, before polygons are cut and materials looked up.
// Floor 3 (scene).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec3.h"

namespace hrad {

struct ObjContent {
  struct Library {
    int64_t line;
    std::string names;  // all after mtllib: one name or several
  };

  std::vector<Vec3> vertices;
  std::vector<int32_t> corners;             // of all faces; indices of vertices from 0
  std::vector<int64_t> first_corner{0};     // per face, and one past the last
  std::vector<int64_t> line;                // per face
  std::vector<int32_t> material;            // per face: index of material_names, or -1
  std::vector<std::string> material_names;  // of usemtl, in order of first use
  std::vector<int64_t> material_line;       // of the first usemtl of each
  std::vector<Library> libraries;
  bool z_up = false;  // marked so
  // What was repaired or ignored, with the first line of each.
  int64_t repeated_corners = 0, first_repeated_corner = 0;
  int64_t vanished = 0;  // numbers too small for a double
  std::string first_vanished;
  struct Count {
    int64_t count = 0, first_line = 0;
  };
  std::map<std::string, Count> ignored;  // known statements that add no surface, by keyword
  Count unknown;
  std::string first_unknown;

  int64_t face_count() const { return static_cast<int64_t>(line.size()); }
};

// path is for messages. SCENE with file:line.
ObjContent parse_obj(const std::string& path, std::string_view text);

}  // namespace hrad
