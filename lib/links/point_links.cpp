// Rough estimates of links, for clusters and for links that carry little: from points that the ends
// bring along, all of them exposed. Floor 6 (links).
#include <algorithm>

#include "base/angle.h"
#include "base/hash.h"
#include "links/form_factor.h"
#include "links/link_guess.h"
#include "links/link_sampler.h"

namespace hrad {
namespace {

// Elements are estimated roughly where the weight may be off by this share of it.
constexpr double rough_enough = 0.03;
// So far apart, as radii over distance, that the sampled kernel is good to a tenth, and to less.
constexpr double apart_for_a_tenth = 1.0, apart_for_less = 0.5;
// Off by this much, a point in each quarter of the smaller end tells the form factor.
constexpr double few_points_enough = 0.2;

constexpr int8_t in_order[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

Vec3 point(const EndPoints& p, int k) { return {p.x[k], p.y[k], p.z[k]}; }

}  // namespace

// Points on the larger of two touching ends, all of it, one for each of the smaller's: half of them
// drawn evenly, half about the point of the smaller end as its light would fall on the plane, for
// most of the light comes from the near part, which is seen best. scale: by how much less often a
// point is drawn than evenly. Returns which lie on the end and are exposed.
uint32_t LinkSampler::place_near(const EndsBySize& ends, const EndPoints& small, uint64_t key,
                                 EndPoints& points, float scale[16]) {
  const Element& large = ends.large;
  const Vec3 ab = large.corners.b - large.corners.a, ac = large.corners.c - large.corners.a;
  const Vec3 across = cross(large.normal, ab);
  const double ab2 = dot(ab, ab), ab_length = std::sqrt(ab2), height_c = dot(ac, across) / ab2;
  const int turn = static_cast<int>(mix(key, 1) & 1);
  float u[16], v[16];
  uint32_t on = all_pairs;
  for (int k = 0; k < 16; ++k) {
    const uint64_t h = mix(key, static_cast<uint64_t>(k) + 2);
    const double a = unit_interval(mix(h, 1)), b = unit_interval(mix(h, 2));
    const Vec3 x = point(small, k) + engine_.center() - large.corners.a;
    const double height = dot(x, large.normal);
    // Of the foot of x: along ab, and across, in lengths of ab.
    const double foot_along = dot(x, ab) / ab2, foot_across = dot(x, across) / ab2;
    if (height > 0 && ((k + k / 4 + turn) & 1)) {
      const double r = height * std::sqrt(a / (1 - a)) / ab_length;
      const Turn t = turn_of(b);
      const double along = foot_along + r * t.cosine, sideways = foot_across + r * t.sine;
      v[k] = static_cast<float>(sideways / height_c);
      u[k] = static_cast<float>(along - sideways / height_c * (dot(ac, ab) / ab2));
      if (u[k] < 0 || v[k] < 0 || u[k] + v[k] > 1) {
        on &= ~(1u << k);
        u[k] = v[k] = 1 / 3.0f;
        scale[k] = 0;
        continue;
      }
    } else {
      point_in_place(Node{}, a, b, &u[k], &v[k]);
    }
    const Vec3 way = ab * u[k] + ac * v[k] - x;
    const double square = dot(way, way);
    const double more_often =
        height > 0 ? large.area * height * height / (pi * square * square) : 1;
    scale[k] = static_cast<float>(2 / (1 + more_often));
  }
  placer().place_at(large, u, v, points);
  return on & exposed_mask(large, u, v);
}

// The pairs of a link; known points of the ends are taken where `keep` says so, or where new ones
// are costly to find. Returns the points of the smaller end.
void LinkSampler::draw_points(const Element& receiver, const Element& source, uint64_t key,
                              bool keep, const LinkEstimate& estimate, DrawnPairs& drawn,
                              EndPoints& of_small) {
  const EndsBySize ends(receiver, source);
  EndPoints from, to;
  const auto place = [&](const Element& end, uint64_t end_key, EndPoints& points) {
    if (end.points && (keep || end.exposed < 1))
      points = *end.points;
    else
      placer().place(end, end_key, points);
  };
  drawn.exposed = all_pairs;
  if (!estimate.near) {
    place(receiver, mix(key, 1), from);
    place(source, mix(key, 2), to);
    pair_up(from, to, pattern_of(key).source_part, drawn.samples);
    return;
  }
  float scale[16];
  place(ends.small, mix(key, 1), of_small);
  drawn.exposed = place_near(ends, of_small, mix(key, 2), to, scale);
  if (ends.receiver_smaller)
    pair_up(of_small, to, in_order, drawn.samples);
  else
    pair_up(to, of_small, in_order, drawn.samples);
  for (int k = 0; k < 16; ++k) drawn.samples.kernel[k] *= scale[k];
}

// False: the link is worth more than a rough estimate.
bool LinkSampler::begin_by_points(const Element& receiver, const Element& source, uint64_t key,
                                  DrawnPairs& drawn, LinkEstimate& estimate, double allowed) {
  const bool clusters = receiver.cluster || source.cluster;
  const LinkGuess guess = guess_of(receiver, source);
  const double tolerance = std::sqrt(allowed / std::max(1e-12, guess.factor));
  if (!clusters && tolerance < rough_enough) return false;
  estimate = LinkEstimate{};
  estimate.by_points = true;
  estimate.guess = guess.factor;
  estimate.variation = guess.variation;
  estimate.near = !clusters && guess.ratio > (tolerance < 0.1 ? apart_for_less : apart_for_a_tenth);
  estimate.source_area = source.exposed_area();
  const EndsBySize ends(receiver, source);
  if (estimate.near) {
    (ends.receiver_smaller ? estimate.source_exposed : estimate.exposed) = ends.large.exposed;
    if (ends.receiver_smaller) estimate.source_area = source.area;
  }
  EndPoints small;
  draw_points(receiver, source, key, true, estimate, drawn, small);
  if (!estimate.near) {
    double sum = 0;
    for (float kernel : drawn.samples.kernel) sum += kernel;
    estimate.factor = std::min(1.0, sum / 16 * estimate.source_area);
    return true;
  }
  // The kernel of near ends is too uneven to be sampled: the share that is seen is.
  const Vec3 center = engine_.center();
  const Triangle large{ends.large.corners.a - center, ends.large.corners.b - center,
                       ends.large.corners.c - center};
  // One of a quarter is any of its four.
  const int step = tolerance < few_points_enough ? 1 : 4;
  const int turn = step == 1 ? 0 : static_cast<int>(mix(key, 4) % 256);
  double mean = 0;
  for (int k = 0; k < 16; k += step)
    mean += point_to_triangle(point(small, k | (turn >> k / 2 & 3)), ends.small.normal, large);
  mean *= step / 16.0;
  estimate.factor = ends.receiver_smaller ? mean : mean * source.exposed_area() / receiver.area;
  if (estimate.factor > estimate.guess) {
    estimate.variation *= estimate.factor / estimate.guess;
    estimate.guess = estimate.factor;
  }
  scale_to(estimate, drawn);
  return true;
}

// Makes the form factor the kernel's mean; where all of it is zero, evenly.
void LinkSampler::scale_to(const LinkEstimate& estimate, DrawnPairs& drawn) {
  float* kernel = drawn.samples.kernel;
  const double mean = estimate.factor / estimate.source_area;
  double sum = 0;
  for (int k = 0; k < 16; ++k) sum += kernel[k];
  for (int k = 0; k < 16; ++k)
    kernel[k] = static_cast<float>(sum > 0 ? kernel[k] * (16 * mean / sum) : mean);
}

}  // namespace hrad
