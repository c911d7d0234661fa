// Boxes and spheres for the physics tests, as polygons.
#pragma once

#include <vector>

#include "physics/vector.h"

namespace physics {

// The six faces of a box, fronts outward (a solid) or inward (a room): x low, x high, y low, y
// high, z low, z high.
inline std::vector<Polygon> box_faces(Vector low, Vector high, bool inward) {
  const Vector x = {high.x - low.x, 0, 0}, y = {0, high.y - low.y, 0}, z = {0, 0, high.z - low.z};
  const auto face = [&](Vector corner, Vector u, Vector v) {  // u x v looks out
    return inward ? parallelogram(corner, v, u) : parallelogram(corner, u, v);
  };
  return {face(low, z, y),     face(low + x, y, z), face(low, x, z),
          face(low + y, z, x), face(low, y, x),     face(low + z, x, y)};
}

// An icosahedron whose triangles are cut in four `levels` times, corners moved out to the sphere.
inline std::vector<Polygon> sphere_faces(Vector center, double radius, int levels, bool inward) {
  const double g = 0.5 * (1 + std::sqrt(5.0));
  const Vector p[12] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                        {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  const int corner[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                             {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                             {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                             {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  std::vector<Polygon> faces;
  for (const auto& c : corner)
    faces.push_back({normalized(p[c[0]]), normalized(p[c[1]]), normalized(p[c[2]])});
  for (int level = 0; level < levels; ++level) {
    std::vector<Polygon> finer;
    for (const Polygon& f : faces) {
      const Vector ab = normalized(f[0] + f[1]), bc = normalized(f[1] + f[2]),
                   ca = normalized(f[2] + f[0]);
      for (const Polygon& part : {Polygon{f[0], ab, ca}, Polygon{ab, f[1], bc},
                                  Polygon{ca, bc, f[2]}, Polygon{ab, bc, ca}})
        finer.push_back(part);
    }
    faces = std::move(finer);
  }
  for (Polygon& f : faces) {
    for (Vector& v : f) v = center + v * radius;
    if (inward) std::swap(f[1], f[2]);
  }
  return faces;
}

}  // namespace physics
