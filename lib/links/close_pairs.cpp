// Dividing the larger end by what the smaller one sees of its parts.
// Floor 6 (links).
#include "links/close_pairs.h"

#include <algorithm>

#include "base/hash.h"
#include "links/form_factor.h"
#include "links/mean_factor.h"

namespace hrad {
namespace {

// The larger end is close when it is nearer than this many of its radii.
constexpr double close_radii = 1.5;
// Nearer than so many of its radii the smaller end is no single point: long slivers beside a wall.
constexpr double alike_radii = 0.25;
// The heaviest part is divided as long as it is larger than this share of its distance, so often at
// the most.
constexpr double small_enough = 0.5;
constexpr int most_divisions = 8;
constexpr int most_parts = 1 + 3 * most_divisions;

// A part of a triangle, and about what is seen of it.
struct Part {
  Node place;
  double area, radius, distance, weight;
};

// The form factor of a sphere of the part's size, never nothing: pairs are weighted by what they
// really bring, so that a wrong guess costs accuracy and no light.
void weigh(Vec3 x, Vec3 normal, const Element& large, Part& part) {
  float u, v;
  point_in_place(part.place, 1.0 / 3, 1.0 / 3, &u, &v);
  const Vec3 d = large.corners.at(u, v) - x;
  const double distance2 = dot(d, d);
  part.distance = std::sqrt(distance2);
  const double reach = part.distance + part.radius;
  const double at_small = std::max(0.0, dot(d, normal)) + 0.3 * part.radius;
  const double at_large = std::max(0.0, -dot(d, large.normal)) + 0.3 * part.radius;
  const double size2 = distance2 + part.radius * part.radius / 4;
  part.weight = part.area * (at_small + 0.02 * reach) * (at_large + 0.02 * reach) / (size2 * size2);
}

// The parts and the running sum of their weights.
struct Division {
  Part parts[most_parts];
  double end[most_parts];
  int count = 0;

  void divide(Vec3 x, Vec3 normal, const Element& large) {
    parts[0] = {Node{}, large.area, large.radius, 0, 0};
    weigh(x, normal, large, parts[0]);
    count = 1;
    for (int division = 0; division < most_divisions; ++division) {
      int heaviest = -1;
      for (int k = 0; k < count; ++k)
        if (parts[k].radius > small_enough * parts[k].distance &&
            (heaviest < 0 || parts[k].weight > parts[heaviest].weight))
          heaviest = k;
      if (heaviest < 0) break;
      const Part whole = parts[heaviest];
      for (int k = 0; k < 4; ++k) {
        Part& part = k == 0 ? parts[heaviest] : parts[count++];
        part = {child_place(whole.place, k), whole.area / 4, whole.radius / 2, 0, 0};
        weigh(x, normal, large, part);
      }
    }
    for (int k = 0; k < count; ++k) end[k] = (k > 0 ? end[k - 1] : 0) + parts[k].weight;
  }
  double sum() const { return end[count - 1]; }
  const Part& at(double share) const {
    return parts[std::upper_bound(end, end + count - 1, share * sum()) - end];
  }
};

Vec3 point_of_small(const EndsBySize& ends, const PairPoints& points, int k) {
  return ends.receiver_smaller ? ends.small.corners.at(points.receiver_u[k], points.receiver_v[k])
                               : ends.small.corners.at(points.source_u[k], points.source_v[k]);
}

}  // namespace

bool is_close(const EndsBySize& ends) {
  return distance_to_triangle(ends.small.centroid, ends.large.corners) <
         close_radii * ends.large.radius;
}

void draw_close_pairs(const Element& receiver, const Element& source, uint64_t key, Vec3 center,
                      double offset, PairPoints& points, PairSamples& samples) {
  const EndsBySize ends(receiver, source);
  const Element &small = ends.small, &large = ends.large;
  float* to_u = ends.receiver_smaller ? points.source_u : points.receiver_u;
  float* to_v = ends.receiver_smaller ? points.source_v : points.receiver_v;
  // Seen from a compact end the parts serve all its points.
  const bool alike =
      distance_to_triangle(small.centroid, large.corners) > alike_radii * small.radius;
  Division division;
  if (alike) division.divide(small.centroid, small.normal, large);
  const int turn = static_cast<int>(mix(key, 0x7475726eu) % 16);
  float scale[16];
  for (int k = 0; k < 16; ++k) {
    const uint64_t h = mix(key, static_cast<uint64_t>(k) + 0x636c6f73u);
    // Sixteen stretches, one each; points of one quarter of the smaller end get stretches far
    // apart, and other ones for other keys.
    const int stretch = (4 * (k % 4) + k / 4 + turn) % 16;
    const double share = (stretch + unit_interval(mix(h, 1))) / 16;
    if (!alike) division.divide(point_of_small(ends, points, k), small.normal, large);
    const Part& part = division.at(share);
    point_in_place(part.place, unit_interval(mix(h, 2)), unit_interval(mix(h, 3)), &to_u[k],
                   &to_v[k]);
    // Drawn so much more often than points spread evenly.
    scale[k] = static_cast<float>(part.area * division.sum() / (part.weight * large.area));
  }
  place_pairs(receiver, source, points, center, offset, samples);
  for (int k = 0; k < 16; ++k) samples.kernel[k] *= scale[k];
}

double mean_kernel(const EndsBySize& ends, const PairPoints& points) {
  double sum = 0;
  for (int k = 0; k < 16; ++k)
    sum +=
        point_to_triangle(point_of_small(ends, points, k), ends.small.normal, ends.large.corners);
  return sum / (16 * ends.large.area);
}

void scale_kernel(double mean, PairSamples& samples) {
  double sum = 0;
  for (float kernel : samples.kernel) sum += kernel;
  if (!(sum > 0)) return;
  const float scale = static_cast<float>(mean * 16 / sum);
  for (float& kernel : samples.kernel) kernel *= scale;
}

}  // namespace hrad
