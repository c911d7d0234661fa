// Joining emitters, and how large they may look. Floor 6 (links).
#include "links/emitters.h"

#include <algorithm>
#include <cmath>

#include "base/angle.h"
#include "base/draw.h"
#include "base/low_discrepancy.h"
#include "base/triangle_points.h"

namespace hrad {
namespace {

constexpr size_t most_surfaces_of_an_emitter = 8;

bool shine_alike(const Scene& scene, const Surface& a, const Surface& b) {
  for (int k = 0; k < scene.bands; ++k)
    if (scene.emission[static_cast<size_t>(a.patch) * scene.bands + k] !=
        scene.emission[static_cast<size_t>(b.patch) * scene.bands + k])
      return false;
  return true;
}

bool share_an_edge(const Triangle& a, const Triangle& b) {
  int common = 0;
  for (const Vec3& p : {a.a, a.b, a.c})
    for (const Vec3& q : {b.a, b.b, b.c}) common += p.x == q.x && p.y == q.y && p.z == q.z;
  return common >= 2;
}

void finish(const Forest& forest, Emitter& e) {
  Vec3 sum{0, 0, 0};
  std::vector<double> areas;
  for (NodeId root : e.surfaces) {
    const double area = forest.surfaces[root].area;
    sum = sum + forest.root_triangle(root).centroid() * area;
    e.area += area;
    areas.push_back(area);
  }
  e.center = sum * (1 / e.area);
  for (NodeId root : e.surfaces) {
    const Triangle t = forest.root_triangle(root);
    for (const Vec3& corner : {t.a, t.b, t.c})
      e.radius = std::max(e.radius, length(corner - e.center));
  }
  const Surface& first = forest.surfaces[e.surfaces.front()];
  const uint64_t key = mix(static_cast<uint64_t>(first.patch), static_cast<uint64_t>(first.side));
  const Draw draw(areas);
  for (uint32_t k = 0; k < 16; ++k) {
    double p[4];
    low_discrepancy_point(key, k, p);
    // The first coordinate picks the surface and goes on within it.
    const size_t pick = draw.pick(p[0]);
    const NodeId root = e.surfaces[pick];
    double u, v;
    even_in_triangle(draw.rest(pick, p[0]), p[1], &u, &v);
    e.point[k] = forest.root_triangle(root).at(u, v);
  }
}

}  // namespace

Emitters::Emitters(const Forest& forest, const std::vector<float>& brightness, double least_bright)
    : of_root_(static_cast<size_t>(forest.surface_count()), -1), least_bright_(least_bright) {
  const Scene& scene = *forest.scene;
  for (NodeId root = 0; root < forest.surface_count(); ++root) {
    const Surface& surface = forest.surfaces[root];
    if (!scene.emits(surface.patch)) continue;
    // In an enclosure the mean radiosity equals the mean irradiance: what shines no brighter than
    // all else makes no noise.
    const double excess = brightness[root] - 1.0;
    if (!(excess > 0)) continue;
    // Faces of one polygon follow each other.
    if (!emitters_.empty()) {
      Emitter& last = emitters_.back();
      const Surface& other = forest.surfaces[last.surfaces.back()];
      if (last.surfaces.size() < most_surfaces_of_an_emitter && last.brightness == excess &&
          share_plane(surface, other) && shine_alike(scene, surface, other) &&
          share_an_edge(forest.root_triangle(root), forest.root_triangle(last.surfaces.back()))) {
        last.surfaces.push_back(root);
        of_root_[root] = static_cast<int32_t>(emitters_.size()) - 1;
        continue;
      }
    }
    of_root_[root] = static_cast<int32_t>(emitters_.size());
    emitters_.emplace_back();
    emitters_.back().normal = surface.normal;
    emitters_.back().brightness = excess;
    emitters_.back().surfaces.push_back(root);
  }
  for (Emitter& e : emitters_) finish(forest, e);
}

bool Emitters::can_be_sampled(const Emitter& e, Vec3 center, double radius, double share) const {
  const Vec3 d = e.center - center;
  const double above = radius - dot(d, e.normal);
  if (!(above > 0)) return false;
  const double distance = std::max(length(d) - radius, e.radius);
  return is_sampled(e, share * std::min(1.0, e.area * std::min(1.0, above / distance) /
                                                 (pi * distance * distance)));
}

double Emitters::rough_factor(const Emitter& e, Vec3 x, Vec3 normal) {
  const Vec3 d = e.center - x;
  const double above = -dot(d, e.normal);
  if (!(above > 0)) return 0;
  const double ahead = dot(d, normal) + e.radius;
  if (!(ahead > 0)) return 0;
  const double distance2 = std::max(dot(d, d), e.radius * e.radius);
  const double distance = std::sqrt(distance2);
  const double at_x = std::min(1.0, ahead / distance), at_emitter = std::min(1.0, above / distance);
  return std::min(1.0, e.area * at_x * at_emitter / (pi * distance2));
}

}  // namespace hrad
