// Ray and plane in double precision. Floor 4 (visibility).
#include "visibility/exact_hit.h"

#include <algorithm>
#include <cmath>

namespace hrad {

double exact_distance(const Triangle& triangle, Vec3 origin, Vec3 direction) {
  const Vec3 normal = triangle.area_vector();
  return dot(normal, triangle.a - origin) / dot(normal, direction);
}

Hit exact_hit(const Scene& scene, int64_t patch, Vec3 origin, Vec3 direction, double single_t) {
  const Triangle triangle = scene.triangle(patch);
  const Vec3 normal = triangle.area_vector();
  Hit hit;
  hit.patch = patch;
  hit.t = exact_distance(triangle, origin, direction);
  if (!std::isfinite(hit.t)) hit.t = single_t;
  hit.back = dot(normal, direction) > 0;
  // Barycentric coordinates of the point by the areas opposite to b and c.
  const Vec3 from_a = origin + direction * hit.t - triangle.a;
  const double whole = dot(normal, normal);
  if (whole > 0) {
    hit.u = dot(cross(from_a, triangle.c - triangle.a), normal) / whole;
    hit.v = dot(cross(triangle.b - triangle.a, from_a), normal) / whole;
  }
  hit.u = std::clamp(hit.u, 0.0, 1.0);
  hit.v = std::clamp(hit.v, 0.0, 1.0);
  const double sum = hit.u + hit.v;
  if (sum > 1) {
    hit.u /= sum;
    hit.v = 1 - hit.u;
  }
  return hit;
}

}  // namespace hrad
