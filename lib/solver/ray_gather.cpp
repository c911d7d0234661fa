// Shadow rays and cosine rays from a point. Floor 8 (solver).
#include "solver/ray_gather.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/frame.h"
#include "base/hash.h"
#include "base/low_discrepancy.h"
#include "base/triangle_points.h"

namespace hrad {
namespace {

double largest_emission(const Scene& scene, int32_t patch) {
  const size_t at = static_cast<size_t>(patch) * scene.bands;
  return *std::max_element(scene.emission.begin() + static_cast<std::ptrdiff_t>(at),
                           scene.emission.begin() + static_cast<std::ptrdiff_t>(at) + scene.bands);
}

// Of being picked by power, beside 1 for the light that would arrive.
constexpr double share_by_power = 0.05;

// Of a doubted solution: rays go on from what reflects more than that, at the most so often and so
// many times.
constexpr double much_reflected = 0.8, most_often = 0.97;
constexpr int most_bounces = 128;

}  // namespace

RayGather::RayGather(const State& state, const LightOfAll& radiosity,
                     const VisibilityEngine& engine, Solution solution)
    : state_(state),
      radiosity_(radiosity),
      engine_(engine),
      solution_(solution),
      emitter_of_(static_cast<size_t>(state.forest.surface_count()), -1) {
  const Scene& scene = *state.forest.scene;
  for (NodeId root = 0; root < state.forest.surface_count(); ++root) {
    const Surface& surface = state.forest.surfaces[root];
    const double power = surface.area * largest_emission(scene, surface.patch);
    if (!(power > 0)) continue;
    emitter_of_[root] = static_cast<int32_t>(emitters_.size());
    emitters_.push_back(root);
    power_.push_back(power);
  }
  by_power_ = Draw(power_);
}

const Draw& RayGather::emitters_near(const Element& receiver, NearEmitters& space) const {
  std::vector<double>& light = space.light;
  light.clear();
  double sum = 0;
  for (size_t e = 0; e < emitters_.size(); ++e) {
    const Element emitter = element_of(state_.forest, state_.forest.nodes[emitters_[e]]);
    const Vec3 d = emitter.centroid - receiver.centroid;
    const double reach = receiver.radius + emitter.radius;
    const double distance2 = std::max(dot(d, d), reach * reach), distance = std::sqrt(distance2);
    const double at_receiver = std::min(1.0, (dot(d, receiver.normal) + reach) / distance);
    const double at_emitter = std::min(1.0, (reach - dot(d, emitter.normal)) / distance);
    light.push_back(power_[e] * std::max(0.0, at_receiver) * std::max(0.0, at_emitter) / distance2);
    sum += light.back();
  }
  if (!(sum > 0)) return by_power_;
  for (size_t e = 0; e < light.size(); ++e)
    light[e] = light[e] / sum + share_by_power * by_power_.chance(e);
  space.draw.assign(light);
  return space.draw;
}

// Emission that arrives from a point of an emitter at distance d may be found by a cosine ray and
// by a shadow ray; all together count it once, and none makes large values where the emitter is
// near: the balance heuristic (Veach and Guibas, SIGGRAPH '95). This is what one ray of either kind
// is worth, as irradiance per emission.
double RayGather::share(size_t emitter, double chance, double distance2, double at_x, double at_y,
                        int cosine_rays) const {
  const double cosine = at_x / pi;
  const double area = state_.forest.surfaces[emitters_[emitter]].area;
  return cosine / (shadow_rays * chance * distance2 / (area * at_y) + cosine_rays * cosine);
}

int64_t RayGather::sample(Vec3 x, Vec3 n, uint64_t key, uint32_t k, int cosine_rays,
                          const Draw& emitters, double* value) const {
  return sample(x, n, key, k, cosine_rays, emitters, 0, value);
}

int64_t RayGather::sample(Vec3 x, Vec3 n, uint64_t key, uint32_t k, int cosine_rays,
                          const Draw& emitters, int bounces, double* value) const {
  std::fill(value, value + state_.bands, 0.0);
  const LowDiscrepancy directions(mix(key, 1));
  int64_t rays = 0;
  for (int j = 0; j < cosine_rays; ++j) {
    double p[4];
    const uint32_t number = k * static_cast<uint32_t>(cosine_rays) + static_cast<uint32_t>(j);
    directions.point(number, p);
    rays += add_by_cosine_ray(x, n, p, mix(key, 3, number), cosine_rays, emitters, bounces, value);
  }
  if (emitters_.empty()) return rays;
  return rays +
         add_by_shadow_rays(x, n, mix(key, 2), k * shadow_rays, cosine_rays, emitters, value);
}

bool RayGather::goes_on(const Hit& hit, double random) const {
  const Scene& scene = *state_.forest.scene;
  const double* reflectance = &scene.reflectance[static_cast<size_t>(hit.patch) * state_.bands];
  const double largest = *std::max_element(reflectance, reflectance + state_.bands);
  return random < std::min(most_often, (largest - much_reflected) / (1 - much_reflected));
}

// Reflected light, and the share of emitted light that such rays are to find.
int64_t RayGather::add_by_cosine_ray(Vec3 x, Vec3 n, const double p[4], uint64_t key,
                                     int cosine_rays, const Draw& emitters, int bounces,
                                     double* value) const {
  const Scene& scene = *state_.forest.scene;
  const Forest& forest = state_.forest;
  const int bands = state_.bands;
  const Vec3 direction = Frame(n).cosine_direction(p[0], p[1]);
  const Hit hit = engine_.nearest(x, direction, 0);
  const NodeId leaf = forest.leaf_met(hit);
  if (leaf < 0) return 1;
  const NodeId root = forest.nodes[leaf].surface;
  // Sealed or not, the emitted part is the patch's own and even.
  const int32_t e = emitter_of_[root];
  const double emitted =
      e >= 0 ? share(static_cast<size_t>(e), emitters.chance(static_cast<size_t>(e)), hit.t * hit.t,
                     dot(direction, n), std::fabs(dot(direction, forest.surfaces[root].normal)),
                     cosine_rays)
             : 0.0;
  int64_t rays = 1;
  double arriving[most_bands];
  const bool doubted =
      solution_ == Solution::doubted && bounces < most_bounces && goes_on(hit, p[2]);
  if (doubted) {
    const Vec3 normal = forest.surfaces[root].normal;
    const Vec3 there = scene.triangle(hit.patch).at(hit.u, hit.v) + normal * engine_.offset();
    rays += sample(there, normal, key, 0, 1, by_power_, bounces + 1, arriving);
  }
  for (int b = 0; b < bands; ++b) {
    const size_t of_patch = static_cast<size_t>(hit.patch) * bands + b;
    const double emission = scene.emission[of_patch];
    const double reflected =
        doubted ? scene.reflectance[of_patch] * arriving[b] : radiosity_[leaf][b] - emission;
    value[b] += reflected / cosine_rays + emitted * emission;
  }
  return rays;
}

int64_t RayGather::add_by_shadow_rays(Vec3 x, Vec3 n, uint64_t key, uint32_t first, int cosine_rays,
                                      const Draw& emitters, double* value) const {
  const Scene& scene = *state_.forest.scene;
  const Forest& forest = state_.forest;
  SegmentPacket packet;
  const Vec3 from = x - engine_.center();
  double worth[shadow_rays];
  int32_t patch[shadow_rays];
  const LowDiscrepancy points(key);
  for (int j = 0; j < shadow_rays; ++j) {
    double p[4], u, v;
    points.point(first + static_cast<uint32_t>(j), p);
    const size_t e = emitters.pick(p[0]);
    const Surface& emitter = forest.surfaces[emitters_[e]];
    even_in_triangle(p[1], p[2], &u, &v);
    const Vec3 y = forest.root_triangle(emitters_[e]).at(u, v) + emitter.normal * engine_.offset();
    const Vec3 d = y - x;
    const double d2 = dot(d, d), at_x = dot(d, n), at_y = -dot(d, emitter.normal);
    packet.set(j, from, y - engine_.center());
    if (!(at_x > 0 && at_y > 0 && d2 > 0)) continue;
    packet.active |= 1u << j;
    const double distance = std::sqrt(d2);
    worth[j] = share(e, emitters.chance(e), d2, at_x / distance, at_y / distance, cosine_rays);
    patch[j] = emitter.patch;
  }
  const uint32_t seen = packet.active & ~engine_.blocked(packet);
  for (int j = 0; j < shadow_rays; ++j) {
    if (!(seen >> j & 1)) continue;
    for (int b = 0; b < state_.bands; ++b)
      value[b] += worth[j] * scene.emission[static_cast<size_t>(patch[j]) * state_.bands + b];
  }
  return __builtin_popcount(packet.active);
}

}  // namespace hrad
