// A surface drawn face by face on the integer grid and triangulated without T-junctions: room
// shells with openings, and extruded profiles. Floor 3 (scene).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/generate_solids.h"
#include "scene/scene.h"

namespace hrad {

using Outline = std::vector<GridPoint>;

// The rectangle at `at` on the axis; low and high bound the two other axes (their coordinate on the
// axis is ignored). Its front faces towards the positive or the negative end of the axis.
Outline rectangle(int axis, int32_t at, GridPoint low, GridPoint high, bool positive);

// The outline, reversed if its front does not face that end of the axis.
Outline facing(Outline outline, int axis, bool positive);

class Polyhedron {
 public:
  // A plane simple polygon, anticlockwise seen from the front. Neighbours need not share corners
  // along edges that run parallel to an axis: add_to inserts each other's corners there.
  void add_face(Outline outline, int32_t material);
  // Welds equal corners and adds the triangles: a face with n corners, those of its neighbours on
  // its edges included, becomes n-2 of them.
  void add_to(Scene& scene) const;

 private:
  struct Face {
    Outline outline;
    int32_t material;
  };
  std::vector<Face> faces_;
};

// The solid swept by a simple profile along an axis from `low` to `high`; profile coordinates are
// those of the next two axes in the cycle x y z. n corners give 4n-4 triangles.
using Profile = std::vector<std::array<int32_t, 2>>;
Polyhedron extrusion(const Profile& profile, int axis, int32_t low, int32_t high,
                     const Place& place, int32_t material);

// Triangles (as indices of corners) of a plane simple polygon, anticlockwise like the polygon; none
// has area zero, even if corners lie on a straight line. Exact: integers alone, ties by index.
std::vector<std::array<int, 3>> triangulate_outline(const Outline& outline);

}  // namespace hrad
