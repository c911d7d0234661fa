// Scenes of triangles at random and an intersection in double precision that shares no code with
// the engines: it says besides when a segment passes so close to an edge or an end that single
// precision may decide either way.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/hash.h"
#include "scene/scene.h"
#include "visibility/visibility.h"

namespace hrad_test {

using hrad::Scene;
using hrad::SegmentPacket;
using hrad::Triangle;
using hrad::Vec3;

class Random {
 public:
  explicit Random(uint64_t seed) : seed_(seed) {}
  double unit() { return hrad::unit_interval(hrad::mix(seed_, count_++)); }
  double between(double low, double high) { return low + (high - low) * unit(); }
  int64_t below(int64_t n) { return std::min(n - 1, static_cast<int64_t>(unit() * n)); }
  Vec3 in_cube(double half) {
    return {between(-half, half), between(-half, half), between(-half, half)};
  }

 private:
  uint64_t seed_, count_ = 0;
};

inline void add_triangle(Scene& scene, Vec3 a, Vec3 b, Vec3 c) {
  if (scene.materials.empty()) scene.add_material({});
  const int32_t first = scene.add_vertex(a);
  scene.add_vertex(b);
  scene.add_vertex(c);
  scene.add_patch(first, first + 1, first + 2, 0);
}

inline void add_quad(Scene& scene, Vec3 corner, Vec3 x, Vec3 y) {
  if (scene.materials.empty()) scene.add_material({});
  const int32_t first = scene.add_vertex(corner);
  scene.add_vertex(corner + x);
  scene.add_vertex(corner + x + y);
  scene.add_vertex(corner + y);
  scene.add_patch(first, first + 1, first + 2, 0);
  scene.add_patch(first, first + 2, first + 3, 0);
}

// Fronts outward, or inward for a room.
inline void add_box(Scene& scene, Vec3 low, Vec3 high, bool inward = false) {
  const Vec3 size = high - low;
  const Vec3 x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
  const Vec3 faces[6][3] = {{low, y, x},    {low, z, y},    {low, x, z},
                            {high, -x, -y}, {high, -y, -z}, {high, -z, -x}};
  for (const Vec3* f : faces)
    inward ? add_quad(scene, f[0], f[2], f[1]) : add_quad(scene, f[0], f[1], f[2]);
}

inline Scene random_soup(int64_t triangles, double size, uint64_t seed) {
  Random random(seed);
  Scene scene;
  for (int64_t i = 0; i < triangles; ++i) {
    const Vec3 p = random.in_cube(1);
    add_triangle(scene, p, p + random.in_cube(size), p + random.in_cube(size));
  }
  return scene;
}

// A room of 12 x 9 x 3 with boxes of all sizes in it, some as flat as paper.
inline Scene room_with_boxes(int64_t boxes, uint64_t seed) {
  Random random(seed);
  Scene scene;
  add_box(scene, {0, 0, 0}, {12, 9, 3}, true);
  for (int64_t i = 0; i < boxes; ++i) {
    const double size = 0.02 + random.unit() * random.unit();
    const Vec3 low{random.between(0.1, 10.5), random.between(0.1, 7.5), random.between(0.01, 1.5)};
    const double height = i % 5 == 0 ? 0.001 : random.between(0.05, 1);
    add_box(scene, low, low + Vec3{size, random.between(0.02, 1), height});
  }
  return scene;
}

struct Crossing {
  bool clear = false;     // beyond doubt
  bool doubtful = false;  // within `doubt` of an edge or an end
  double t = 0;
};

// Solves origin + t direction = a + u (b - a) + v (c - a) by Cramer's rule; doubt is a length.
inline Crossing cross_triangle(const Triangle& triangle, Vec3 origin, Vec3 direction,
                               double doubt) {
  const Vec3 p = triangle.b - triangle.a, q = triangle.c - triangle.a, s = origin - triangle.a;
  const Vec3 n = hrad::cross(p, q);
  const double area = hrad::length(n), size = hrad::length(direction);
  Crossing result;
  if (area == 0) return result;
  const double determinant = -hrad::dot(n, direction);
  const double height = hrad::dot(n, s) / area;
  const double end_height = height - determinant / area;
  if (std::fabs(determinant) < 1e-9 * area * size) {  // parallel
    result.doubtful = std::fabs(height) < doubt;
    return result;
  }
  result.t = hrad::dot(n, s) / determinant;
  const Vec3 point = origin + direction * result.t;
  const Vec3 corners[3] = {triangle.a, triangle.b, triangle.c};
  const double sharpness = std::fabs(determinant) / (area * size);  // sine to the plane
  double inside = 1e300;  // distance to the nearest edge line, negative outside
  for (int k = 0; k < 3; ++k) {
    const Vec3 edge = corners[(k + 1) % 3] - corners[k];
    inside = std::min(
        inside, hrad::dot(hrad::cross(n, edge), point - corners[k]) / (area * hrad::length(edge)));
  }
  if (inside < -doubt / sharpness) return result;
  const bool straddles = (height > 0) != (end_height > 0);
  const double slack = std::min(std::fabs(height), std::fabs(end_height));
  if (!straddles && slack > doubt) return result;
  result.clear = straddles && slack > doubt && inside > doubt / sharpness;
  result.doubtful = !result.clear;
  return result;
}

inline Vec3 packet_origin(const SegmentPacket& packet, int i, Vec3 center) {
  return center + Vec3{packet.ox[i], packet.oy[i], packet.oz[i]};
}
inline Vec3 packet_direction(const SegmentPacket& packet, int i) {
  return {packet.dx[i], packet.dy[i], packet.dz[i]};
}

inline void set_segment(SegmentPacket& packet, int i, Vec3 from, Vec3 to, Vec3 center) {
  packet.set(i, from - center, to - center);
  packet.active |= 1u << i;
}

inline Vec3 point_on(const Triangle& triangle, Random& random) {
  const double r = std::sqrt(random.unit()), s = random.unit();
  return triangle.at(r * (1 - s), r * s);
}

// Sixteen segments between two triangles, each end moved off towards the other.
inline SegmentPacket packet_between(const Triangle& a, const Triangle& b, double offset,
                                    Vec3 center, Random& random) {
  SegmentPacket packet;
  const Vec3 na = hrad::normalized(a.area_vector()), nb = hrad::normalized(b.area_vector());
  for (int i = 0; i < 16; ++i) {
    const Vec3 p = point_on(a, random), q = point_on(b, random);
    const double up = hrad::dot(na, q - p) > 0 ? offset : -offset;
    const double down = hrad::dot(nb, p - q) > 0 ? offset : -offset;
    set_segment(packet, i, p + na * up, q + nb * down, center);
  }
  return packet;
}

// Sixteen unrelated segments.
inline SegmentPacket loose_packet(Vec3 low, Vec3 high, Vec3 center, Random& random) {
  SegmentPacket packet;
  const auto point = [&] {
    return Vec3{random.between(low.x, high.x), random.between(low.y, high.y),
                random.between(low.z, high.z)};
  };
  for (int i = 0; i < 16; ++i) {
    const Vec3 from = point();
    set_segment(packet, i, from, point(), center);
  }
  return packet;
}

}  // namespace hrad_test
