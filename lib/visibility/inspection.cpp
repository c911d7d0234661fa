// A few thousand rays from the fronts of surfaces. Floor 4 (visibility).
#include "visibility/inspection.h"

#include <algorithm>
#include <vector>

#include "base/draw.h"
#include "base/frame.h"
#include "base/hash.h"
#include "base/triangle_points.h"
#include "machine/process_usage.h"

namespace hrad {

namespace {

constexpr int rays_of_a_half = 2048;
// A patch of this many offsets is a point to the rays.
constexpr double smallest_in_offsets = 4;

// Shoots from patches drawn in proportion to their areas.
class Rays {
 public:
  Rays(const Scene& scene, const VisibilityEngine& engine, const Exposure& exposure)
      : scene_(scene), engine_(engine), exposure_(exposure) {}

  // Points inside solids are left out, as nothing is seen there, unless told otherwise: a lamp in
  // an inside-out room is inside a solid.
  void shoot(const std::vector<int64_t>& patches, const std::vector<double>& areas,
             bool also_in_solids) {
    const Draw draw(areas);
    if (!(draw.total() > 0)) return;
    const double start = thread_seconds();
    for (int k = 0; k < rays_of_a_half; ++k) {
      const uint64_t h = mix(static_cast<uint64_t>(k), 0x696e7370u);
      shoot_from(patches[draw.pick((k + unit_interval(h)) / rays_of_a_half)], also_in_solids, h);
    }
    seconds_ += thread_seconds() - start;
  }

  double mean_distance() const {
    return distances_ ? distance_ / static_cast<double>(distances_) : engine_.radius();
  }
  double seconds_of_a_ray() const { return rays_ ? seconds_ / static_cast<double>(rays_) : 0; }
  double back_share() const {
    return rays_ ? static_cast<double>(backs_) / static_cast<double>(rays_) : 0;
  }

 private:
  void shoot_from(int64_t patch, bool also_in_solids, uint64_t h) {
    const Triangle triangle = scene_.triangle(patch);
    double u = unit_interval(mix(h, 1)), v = unit_interval(mix(h, 2));
    fold_into_triangle(u, v);
    const Vec3 point = triangle.at(u, v), normal = normalized(triangle.area_vector());
    if (also_in_solids ? exposure_.pressed(patch, 0, point) : exposure_.sealed(patch, 0, point))
      return;
    const Vec3 direction =
        Frame(normal).cosine_direction(unit_interval(mix(h, 3)), unit_interval(mix(h, 4)));
    const Hit hit = engine_.nearest(point + normal * engine_.offset(), direction, 0);
    ++rays_;
    if (!also_in_solids && hit.patch >= 0) {
      distance_ += hit.t;
      ++distances_;
    }
    backs_ += hit.patch >= 0 && hit.back && scene_.exchanges(hit.patch) &&
              !scene_.has(hit.patch, patch_two_sided);
  }

  const Scene& scene_;
  const VisibilityEngine& engine_;
  const Exposure& exposure_;
  int64_t rays_ = 0, backs_ = 0, distances_ = 0;
  double distance_ = 0, seconds_ = 0;
};

}  // namespace

Inspection inspect(const Scene& scene, const VisibilityEngine& engine, const Exposure& exposure) {
  Inspection result;
  result.smallest = smallest_in_offsets * engine.offset();
  std::vector<int64_t> all, emitters;
  std::vector<double> area_of_all, area_of_emitters;
  for (int64_t patch = 0; patch < scene.patch_count(); ++patch) {
    if (scene.has(patch, patch_dropped)) continue;
    const Triangle t = scene.triangle(patch);
    const double longest = std::max({length(t.b - t.a), length(t.c - t.b), length(t.a - t.c)});
    if (longest <= result.smallest && result.unresolved++ == 0) result.first_unresolved = patch;
    if (!scene.exchanges(patch)) continue;
    const double area = length(t.area_vector()) / 2;
    all.push_back(patch);
    area_of_all.push_back(area);
    if (!scene.emits(patch)) continue;
    emitters.push_back(patch);
    area_of_emitters.push_back(area);
  }
  Rays rays(scene, engine, exposure);
  rays.shoot(emitters, area_of_emitters, true);
  rays.shoot(all, area_of_all, false);
  result.seconds_of_a_ray = rays.seconds_of_a_ray();
  result.back_share = rays.back_share();
  result.mean_distance = rays.mean_distance();
  return result;
}

}  // namespace hrad
