// Boxes on an integer grid: the bricks of the built-in scenes. Each is a closed manifold of its
// own. Floor 3 (scene).
#pragma once

#include <array>
#include <cstdint>

#include "scene/scene.h"

namespace hrad {

// In millimetres. Equal integers give equal coordinates, so that faces meant to touch do.
struct GridPoint {
  int32_t x = 0, y = 0, z = 0;
  int32_t operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};
inline GridPoint operator+(GridPoint a, GridPoint b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

Vec3 metres(GridPoint p);

// Where a piece of furniture stands: turned half round or not, then moved to `origin`.
struct Place {
  GridPoint origin;
  bool turned = false;  // about z
  GridPoint operator()(GridPoint local) const {
    return origin + (turned ? GridPoint{-local.x, -local.y, local.z} : local);
  }
  // The place of something that stands at `local` of this one, turned against it or not.
  Place at(GridPoint local, bool against = false) const {
    return {(*this)(local), turned != against};
  }
};

// One material for each face, in the order -x +x -y +y -z +z.
using BoxMaterials = std::array<int32_t, 6>;
BoxMaterials all_faces(int32_t material);

// 12 triangles with fronts outward.
void add_box(Scene& scene, GridPoint low, GridPoint high, const BoxMaterials& materials);
void add_box(Scene& scene, const Place& place, GridPoint low, GridPoint high, int32_t material);

// 12 triangles with fronts inward: a closed room.
void add_room(Scene& scene, GridPoint low, GridPoint high, const BoxMaterials& materials);

// A closed box that shines through its bottom.
void add_lamp(Scene& scene, GridPoint low, GridPoint high, int32_t housing, int32_t light);

}  // namespace hrad
