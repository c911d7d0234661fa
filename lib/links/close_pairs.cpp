// Dividing the larger end by what the smaller one sees of its parts.
// Floor 6 (links).
#include "links/close_pairs.h"

#include <algorithm>

#include "base/hash.h"
#include "links/form_factor.h"
#include "links/kernel_parts.h"
#include "links/mean_factor.h"

namespace hrad {
namespace {

// The larger end is close when it is nearer than this many of its radii.
constexpr double close_radii = 1.5;
// Nearer than so many of its radii the smaller end is no single point: long slivers beside a wall.
constexpr double alike_radii = 0.25;

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
  KernelParts division;
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
    const KernelPart& part = division.at(share);
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
