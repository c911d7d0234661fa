// Fuzz target: any bytes as an OBJ file. Reading ends with a scene or a typed error that names the
// file; the patches that come out are checked as those of users are.
#include <cstdlib>
#include <string>

#include "base/error.h"
#include "fuzz/target.h"
#include "scene/load.h"
#include "scene/obj_content.h"
#include "scene/triangulate.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  hrad::Scene scene;
  try {
    const hrad::ObjContent content =
        hrad::parse_obj("fuzz.obj", std::string_view(reinterpret_cast<const char*>(data), size));
    hrad::Material material;
    scene.add_material(material);
    scene.vertices = content.vertices;
    std::vector<hrad::Vec3> polygon;
    std::vector<std::array<int32_t, 3>> triangles;
    for (int64_t face = 0; face < content.face_count(); ++face) {
      const int32_t* corners = &content.corners[content.first_corner[face]];
      const int64_t count = content.first_corner[face + 1] - content.first_corner[face];
      polygon.clear();
      triangles.clear();
      for (int64_t i = 0; i < count; ++i) polygon.push_back(content.vertices[corners[i]]);
      hrad::triangulate(polygon, triangles);
      for (const auto& t : triangles)
        scene.add_patch(corners[t[0]], corners[t[1]], corners[t[2]], 0, face);
    }
    hrad::check_patches(scene, 0);
  } catch (const hrad::Error& error) {
    if (error.status() != hrad::Status::scene || std::string(error.what()).rfind("fuzz.obj:", 0))
      std::abort();
  }
  return 0;
}
