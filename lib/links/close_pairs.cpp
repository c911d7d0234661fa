// Dividing the larger end by what the smaller one sees of its parts.
// Floor 6 (links).
#include "links/close_pairs.h"

#include <algorithm>

#include "base/hash.h"
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

// A part of a triangle: the coordinates (u,v) of its corners, and about what is seen of it.
struct Part {
  double u[3], v[3];
  double area, radius, distance, weight;
};

Part quarter(const Part& p, int k) {
  double mu[3], mv[3];  // of the edges opposite the corners
  for (int e = 0; e < 3; ++e) {
    mu[e] = (p.u[(e + 1) % 3] + p.u[(e + 2) % 3]) / 2;
    mv[e] = (p.v[(e + 1) % 3] + p.v[(e + 2) % 3]) / 2;
  }
  const int next = (k + 1) % 3, last = (k + 2) % 3;
  Part part = k == 3 ? Part{{mu[0], mu[1], mu[2]}, {mv[0], mv[1], mv[2]}, 0, 0, 0, 0}
                     : Part{{p.u[k], mu[last], mu[next]}, {p.v[k], mv[last], mv[next]}, 0, 0, 0, 0};
  part.area = p.area / 4;
  part.radius = p.radius / 2;
  return part;
}

// The form factor of a sphere of the part's size, never nothing: pairs are weighted by what they
// really bring, so that a wrong guess costs accuracy and no light.
void weigh(Vec3 x, Vec3 normal, const Element& large, Part& part) {
  const Vec3 middle = large.corners.at((part.u[0] + part.u[1] + part.u[2]) / 3,
                                       (part.v[0] + part.v[1] + part.v[2]) / 3);
  const Vec3 d = middle - x;
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
    parts[0] = {{0, 1, 0}, {0, 0, 1}, large.area, large.radius, 0, 0};
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
        part = quarter(whole, k);
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

}  // namespace

bool is_close(const Element& receiver, const Element& source) {
  const bool up = receiver.area <= source.area;
  const Element &small = up ? receiver : source, &large = up ? source : receiver;
  return distance_to_triangle(small.centroid, large.corners) < close_radii * large.radius;
}

void draw_close_pairs(const Element& receiver, const Element& source, uint64_t key, Vec3 center,
                      double offset, PairPoints& points, PairSamples& samples) {
  const bool up = receiver.area <= source.area;
  const Element &small = up ? receiver : source, &large = up ? source : receiver;
  float* to_u = up ? points.source_u : points.receiver_u;
  float* to_v = up ? points.source_v : points.receiver_v;
  const float* from_u = up ? points.receiver_u : points.source_u;
  const float* from_v = up ? points.receiver_v : points.source_v;
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
    if (!alike) division.divide(small.corners.at(from_u[k], from_v[k]), small.normal, large);
    const Part& part = division.at(share);
    double a = unit_interval(mix(h, 2)), b = unit_interval(mix(h, 3));
    if (a + b > 1) {
      a = 1 - a;
      b = 1 - b;
    }
    const double c = 1 - a - b;
    to_u[k] = static_cast<float>(part.u[0] * c + part.u[1] * a + part.u[2] * b);
    to_v[k] = static_cast<float>(part.v[0] * c + part.v[1] * a + part.v[2] * b);
    // Drawn so much more often than points spread evenly.
    scale[k] = static_cast<float>(part.area * division.sum() / (part.weight * large.area));
  }
  place_pairs(receiver, source, points, center, offset, samples);
  for (int k = 0; k < 16; ++k) samples.kernel[k] *= scale[k];
}

}  // namespace hrad
