// Building a scene patch by patch. Floor 3 (scene).
#include "scene/scene.h"

#include <algorithm>

#include <limits>
#include <utility>

#include "base/error.h"

namespace hrad {

int32_t Scene::add_material(Material m) {
  m.reflectance.resize(bands, 0.5);
  m.emission.resize(bands, 0.0);
  materials.push_back(std::move(m));
  return static_cast<int32_t>(materials.size() - 1);
}

int32_t Scene::add_vertex(Vec3 v) {
  if (vertices.size() >= static_cast<size_t>(std::numeric_limits<int32_t>::max()))
    fail(Status::scene, "the scene has more than 2^31-1 vertices");
  vertices.push_back(v);
  return static_cast<int32_t>(vertices.size() - 1);
}

void Scene::add_patch(int32_t a, int32_t b, int32_t c, int32_t material_number,
                      int64_t face_number) {
  const Material& m = materials[material_number];
  corners.push_back({a, b, c});
  material.push_back(material_number);
  face.push_back(face_number < 0 ? patch_count() - 1 : face_number);
  flags.push_back(static_cast<uint8_t>((m.two_sided ? patch_two_sided : 0) |
                                       (m.blocker ? patch_blocker : 0)));
  emission.insert(emission.end(), m.emission.begin(), m.emission.end());
  reflectance.insert(reflectance.end(), m.reflectance.begin(), m.reflectance.end());
}

bool Scene::emits(int64_t patch) const {
  const double* first = &emission[static_cast<size_t>(patch) * bands];
  return std::any_of(first, first + bands, [](double e) { return e > 0; });
}

int64_t Scene::bytes() const {
  return static_cast<int64_t>(
      vertices.capacity() * sizeof(Vec3) + corners.capacity() * sizeof corners[0] +
      material.capacity() * sizeof material[0] + face.capacity() * sizeof face[0] +
      flags.capacity() + (emission.capacity() + reflectance.capacity()) * sizeof(double));
}

Box Scene::bounds() const {
  Box box;
  for (const auto& c : corners)
    for (int32_t v : c) box.grow(vertices[v]);
  return box;
}

}  // namespace hrad
