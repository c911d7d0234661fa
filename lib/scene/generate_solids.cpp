// Boxes on an integer grid: the bricks of the built-in scenes. Floor 3 (scene).
#include "scene/generate_solids.h"

#include <algorithm>

namespace hrad {
namespace {

// Corner number: bit 0 is x, bit 1 y, bit 2 z. Each face anticlockwise seen from outside.
constexpr int box_faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                 {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

void add_box_faces(Scene& scene, GridPoint low, GridPoint high, const BoxMaterials& materials,
                   bool inward) {
  std::array<int32_t, 8> corner;
  for (int i = 0; i < 8; ++i)
    corner[i] = scene.add_vertex(
        metres({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z}));
  for (int face = 0; face < 6; ++face) {
    const int* quad = box_faces[face];
    const int second = inward ? 3 : 1, fourth = inward ? 1 : 3;
    scene.add_patch(corner[quad[0]], corner[quad[second]], corner[quad[2]], materials[face]);
    scene.add_patch(corner[quad[0]], corner[quad[2]], corner[quad[fourth]], materials[face]);
  }
}

}  // namespace

// A quotient, not a product with 0.001: the nearest double to the decimal fraction.
Vec3 metres(GridPoint p) { return {p.x / 1000.0, p.y / 1000.0, p.z / 1000.0}; }

BoxMaterials all_faces(int32_t material) {
  BoxMaterials materials;
  materials.fill(material);
  return materials;
}

void add_box(Scene& scene, GridPoint low, GridPoint high, const BoxMaterials& materials) {
  add_box_faces(scene, low, high, materials, false);
}

void add_box(Scene& scene, const Place& place, GridPoint low, GridPoint high, int32_t material) {
  const GridPoint a = place(low), b = place(high);
  add_box(scene, {std::min(a.x, b.x), std::min(a.y, b.y), a.z},
          {std::max(a.x, b.x), std::max(a.y, b.y), b.z}, all_faces(material));
}

void add_room(Scene& scene, GridPoint low, GridPoint high, const BoxMaterials& materials) {
  add_box_faces(scene, low, high, materials, true);
}

void add_lamp(Scene& scene, GridPoint low, GridPoint high, int32_t housing, int32_t light) {
  BoxMaterials materials = all_faces(housing);
  materials[4] = light;
  add_box(scene, low, high, materials);
}

}  // namespace hrad
