// Shadow rays. Floor 6 (links).
#include "links/direct_light.h"

#include <algorithm>
#include <cmath>

#include "base/angle.h"
#include "base/hash.h"
#include "base/low_discrepancy.h"
#include "links/form_factor.h"
#include "links/kernel_parts.h"
#include "links/pair_samples.h"

namespace hrad {
namespace {

// An emitter nearer than this many of its radii is sampled by what is seen of its parts.
constexpr double near_radii = 2;
// Farther than so many, and wholly above the horizon, its form factor is the kernel's mean by a
// quadratic rule, or by one point: they err by about the inverse fourth power and the inverse
// square of these.
constexpr double quadratic_radii = 8, point_radii = 30;
// Variance of what one ray says: at the most, and where some thirty pilot rays met nothing.
constexpr double variance_at_most = 0.25, variance_if_hidden = 1.0 / 32;
// Where those met nothing and less than a ray would do, it is traced by chance, no smaller than
// this: nearly all of them meet nothing either.
constexpr double least_chance = 0.125;
// Sixteen rays that are spread evenly do for so many times as many by chance, where few points lie
// in a penumbra.
constexpr double gain_of_evenness = 16;

// cos cos / distance^2, 0 behind a horizon.
double kernel(Vec3 x, Vec3 normal, Vec3 y, Vec3 normal_y) {
  const Vec3 d = y - x;
  const double at_x = dot(d, normal), at_y = -dot(d, normal_y), distance2 = dot(d, d);
  return at_x > 0 && at_y > 0 ? at_x * at_y / (distance2 * distance2) : 0;
}

// Form factor of a source from a point on a receiver that faces `normal`; radii: its distance.
double factor_from(Vec3 x, Vec3 normal, const Triangle& source, Vec3 normal_y, double radii,
                   bool above_horizon) {
  if (!above_horizon || radii < quadratic_radii) return point_to_triangle(x, normal, source);
  const double share = length(source.area_vector()) / (2 * pi);
  if (radii > point_radii) return share * kernel(x, normal, source.centroid(), normal_y);
  // Middles of the edges (Stroud, "Approximate calculation of multiple integrals", 1971,
  // Section 8.8).
  return share / 3 *
         (kernel(x, normal, (source.a + source.b) * 0.5, normal_y) +
          kernel(x, normal, (source.b + source.c) * 0.5, normal_y) +
          kernel(x, normal, (source.c + source.a) * 0.5, normal_y));
}

// By how much the exposed part of an emitter lies better, or worse, than all of it.
double gain_of_place(const Emitter& e, Vec3 x, Vec3 normal) {
  const double even = kernel(x, normal, e.even_center, e.normal);
  return even > 0 ? kernel(x, normal, e.exposed_center, e.normal) / even : 1;
}

}  // namespace

// A packet under way, with the rays of one emitter or of several.
struct DirectLight::Batch {
  struct Part {
    const Emitter* emitter;
    int first, rays;
    double chance;  // by which these rays are traced at all
    double factor;  // of a group: without occlusion
  };

  void aim(const VisibilityEngine& engine, const OrientedPoint& from, const OrientedPoint& to,
           double weight_of_ray) {
    weight[used] = weight_of_ray;
    packet.set(used, from.place + from.normal * engine.offset() - engine.center(),
               to.place + (to.normal * engine.offset() - engine.center()));
    if (weight_of_ray > 0) packet.active |= 1u << used;
    ++used;
  }
  // Towards one of an emitter's points.
  void aim_at(const VisibilityEngine& engine, const OrientedPoint& from, const Emitter& e,
              size_t k) {
    const Vec3 y = e.point(k);
    aim(engine, from, {y, e.normal}, kernel(from.place, from.normal, y, e.normal));
  }
  // The weights of some of the rays, and of those that are seen.
  void add_up(uint32_t seen, int first, int count, Weights& sum) const {
    for (int k = first; k < first + count; ++k) {
      sum.all += weight[k];
      if (seen >> k & 1) sum.visible += weight[k];
    }
  }
  // Which rays nothing stops.
  uint32_t trace(const VisibilityEngine& engine) {
    for (int k = used; k < 16; ++k) packet.set(k, Vec3{0, 0, 0}, Vec3{1, 0, 0});
    rays += __builtin_popcount(packet.active);
    return packet.active & ~engine.blocked(packet);
  }
  void clear() {
    packet.active = 0;
    part_count = used = 0;
  }

  SegmentPacket packet;
  double weight[16];
  std::vector<double> up_to;  // of a group: the sum of form factors up to each member
  Part parts[16];
  int part_count = 0, used = 0;
  int64_t rays = 0;
};

DirectLight::DirectLight(const Forest& forest, const VisibilityEngine& engine,
                         const Emitters& emitters, const LightGrid& grid, double noise)
    : forest_(forest), engine_(engine), emitters_(emitters), grid_(grid), noise_(noise) {}

int64_t DirectLight::sample(const OrientedPoint& point, uint64_t key,
                            std::vector<Link>& links) const {
  Batch batch;
  int64_t rays = 0;
  for (const LightGrid::Candidate& candidate : grid_.at(point)) {
    const Emitter& e = emitters_.all()[candidate.emitter];
    const Wanted wanted = wanted_of(e, candidate.hidden, point.place, point.normal);
    if (wanted.rays == 0) continue;
    const uint64_t own_key = mix(key, static_cast<uint64_t>(e.surfaces.front()));
    if (!is_near(e, point)) {
      if (wanted.chance < 1 && unit_interval(mix(own_key, 0x6368616e6365u)) >= wanted.chance)
        continue;
      if (batch.used + wanted.rays > 16) finish(point, batch, links);
      if (e.members.empty())
        add(e, wanted, own_key, point, batch);
      else
        add_group(e, wanted, own_key, point, batch);
    } else {
      for (NodeId root : e.surfaces)
        rays += sample_near(root, point, mix(own_key, static_cast<uint64_t>(root)), links);
    }
  }
  finish(point, batch, links);
  return rays + batch.rays;
}

bool DirectLight::is_near(const Emitter& e, const OrientedPoint& point) {
  return !(length(e.center - point.place) > near_radii * e.radius);
}

// Links mostly come in the order of the candidates.
double DirectLight::light_of(const OrientedPoint& point, Span<const Link> links,
                             const std::vector<float>& brightness) const {
  const std::vector<LightGrid::Candidate>& there = grid_.at(point);
  double sum = 0;
  auto next = there.begin();
  for (const Link& link : links) {
    const int32_t emitter = emitters_.of_node(link.source);
    if (next == there.end() || next->emitter > emitter) next = there.begin();
    while (next != there.end() && next->emitter < emitter) ++next;
    double chance = 1;
    if (next != there.end() && next->emitter == emitter && next->hidden) {
      const Emitter& e = emitters_.all()[emitter];
      if (!is_near(e, point)) chance = wanted_of(e, true, point.place, point.normal).chance;
    }
    sum += chance * static_cast<double>(link.weight) * brightness[link.source];
  }
  return sum;
}

double DirectLight::rays_at(const OrientedPoint& point) const {
  double rays = 0;
  for (const LightGrid::Candidate& candidate : grid_.at(point)) {
    const Wanted wanted =
        wanted_of(emitters_.all()[candidate.emitter], candidate.hidden, point.place, point.normal);
    rays += wanted.rays * wanted.chance;
  }
  return rays;
}

// By chance, for the visible share of so much light.
double DirectLight::rays_for(double light, double variance) const {
  return light * light * variance / (noise_ * noise_);
}

DirectLight::Wanted DirectLight::wanted_of(const Emitter& e, bool hidden, Vec3 x,
                                           Vec3 normal) const {
  const double factor = Emitters::rough_factor(e, x, normal);
  if (!emitters_.is_sampled(e, factor)) return {0, 1};
  // Partly below the horizon, few points may miss all of it. Those of a group never do.
  if (e.members.empty() && dot(e.center - x, normal) < e.radius) return {16, 1};
  const double rays =
      rays_for(e.brightness * factor, hidden ? variance_if_hidden : variance_at_most);
  // No weight becomes larger than 1 by it.
  const double chance = hidden ? std::min(1.0, std::max({least_chance, rays, 2 * factor})) : 1;
  return {rays > 4 ? 16 : rays > 1 ? 4 : 1, chance};
}

void DirectLight::add(const Emitter& e, const Wanted& wanted, uint64_t key,
                      const OrientedPoint& point, Batch& batch) const {
  const int rays = wanted.rays;
  batch.parts[batch.part_count++] = {&e, batch.used, rays, wanted.chance, 0};
  // All sixteen points, or some of them that are spread evenly, other ones for every receiver.
  const size_t turn = rays == 16 ? 0 : key % 16;
  for (int k = 0; k < rays; ++k)
    batch.aim_at(engine_, point, e, (turn + static_cast<size_t>(k * (16 / rays))) % 16);
}

// Rays in proportion to what the members would bring without occlusion, so that the visible share
// needs no weights: some may be much nearer than others.
void DirectLight::add_group(const Emitter& group, const Wanted& wanted, uint64_t key,
                            const OrientedPoint& point, Batch& batch) const {
  const int rays = wanted.rays;
  double all = 0;
  batch.up_to.clear();
  for (int32_t member : group.members) {
    const Emitter& e = emitters_.all()[member];
    all += kernel(point.place, point.normal, e.center, e.normal) * e.exposed_area / pi;
    batch.up_to.push_back(all);
  }
  if (!(all > 0)) return;
  const double start = unit_interval(mix(key, 0x67726f7570u));
  const int first = batch.used;
  size_t turn = key % 16;
  for (size_t m = 0; m < group.members.size(); ++m) {
    const Emitter& e = emitters_.all()[group.members[m]];
    for (; batch.used - first < rays && (start + batch.used - first) / rays * all < batch.up_to[m];
         ++turn)
      batch.aim(engine_, point, {e.point(turn % 16), e.normal}, 1);
  }
  batch.parts[batch.part_count++] = {&group, first, batch.used - first, wanted.chance, all};
}

void DirectLight::finish(const OrientedPoint& point, Batch& batch, std::vector<Link>& links) const {
  if (batch.used == 0) return;
  const uint32_t seen = batch.trace(engine_);
  for (int p = 0; p < batch.part_count; ++p) {
    const Batch::Part& part = batch.parts[p];
    const Emitter& e = *part.emitter;
    Weights sum;
    batch.add_up(seen, part.first, part.rays, sum);
    // A strip above the horizon that all points miss is taken for visible.
    if (sum.all > 0 && !(sum.visible > 0)) continue;
    if (part.rays == 16 && e.members.empty() && sum.visible < sum.all)
      batch.rays += look_closer(e, point, sum);
    const double share = (sum.all > 0 ? sum.visible / sum.all : 1) / part.chance;
    const Vec3 way = e.center - point.place;
    const double radii = length(way) / e.radius;
    const bool above_horizon = dot(way, point.normal) > e.radius;
    if (part.factor > 0) {
      links.push_back({e.cluster, static_cast<float>(part.factor * share)});
      continue;
    }
    const bool partly_sealed = e.exposed_area < e.area && above_horizon;
    const double gain = partly_sealed ? gain_of_place(e, point.place, point.normal) : 1;
    for (size_t k = 0; k < e.surfaces.size(); ++k) {
      const NodeId root = e.surfaces[k];
      const double factor = factor_from(point.place, point.normal, forest_.root_triangle(root),
                                        e.normal, radii, above_horizon);
      if (factor > 0)
        links.push_back({root, static_cast<float>(factor * e.exposed[k] * gain * share)});
    }
  }
  batch.clear();
}

// Sixteen rays leave steps in the penumbra of a strong emitter: 16, 32 or 64.
size_t DirectLight::rays_of_penumbra(double light) const {
  const double wanted = rays_for(light, variance_at_most) / gain_of_evenness;
  return wanted > 64 ? Emitter::point_count : wanted > 16 ? 32 : 16;
}

// After sixteen rays; returns the number of those that are added.
int64_t DirectLight::look_closer(const Emitter& e, const OrientedPoint& point, Weights& sum) const {
  const double factor = Emitters::rough_factor(e, point.place, point.normal);
  const size_t most = rays_of_penumbra(e.brightness * factor);
  int64_t rays = 0;
  for (size_t first = 16; first < most; first += 16) {
    Batch batch;
    for (size_t k = first; k < first + 16; ++k) batch.aim_at(engine_, point, e, k);
    batch.add_up(batch.trace(engine_), 0, 16, sum);
    rays += batch.rays;
  }
  return rays;
}

int64_t DirectLight::sample_near(NodeId root, const OrientedPoint& point, uint64_t key,
                                 std::vector<Link>& links) const {
  const Vec3 x = point.place, normal = point.normal;
  const Element element = element_of(forest_, forest_.nodes[root]);
  const Triangle& corners = element.corners;
  const double factor = point_to_triangle(x, normal, corners);
  if (!(factor > 0)) return 0;
  KernelParts parts;
  parts.divide(x, normal, element);
  const Emitter& emitter = emitters_.all()[emitters_.of_node(root)];
  const size_t most = rays_of_penumbra(emitter.brightness * factor);
  Weights sum;
  int64_t rays = 0;
  for (size_t first = 0; first < most; first += 16) {
    Batch batch;
    for (size_t k = first; k < first + 16; ++k) {
      double p[4];
      low_discrepancy_point(key, static_cast<uint32_t>(k), p);
      const KernelPart& part = parts.at(p[0]);
      float u, v;
      point_in_place(part.place, p[1], p[2], &u, &v);
      const Vec3 y = corners.at(u, v);
      // Drawn in proportion to the part's weight over its area.
      batch.aim(engine_, point, {y, element.normal},
                kernel(x, normal, y, element.normal) * part.area / part.weight);
    }
    batch.add_up(batch.trace(engine_), 0, 16, sum);
    rays += batch.rays;
    if (!(sum.visible > 0) || !(sum.visible < sum.all)) break;
  }
  const double seen = sum.all > 0 ? sum.visible / sum.all : 1;
  if (seen > 0) links.push_back({root, static_cast<float>(factor * seen)});
  return rays;
}

}  // namespace hrad
