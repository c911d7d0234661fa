// Patterns of sample pairs, made once, and the kernel between them. Floor 6 (links).
#include "links/pair_samples.h"

#include <vector>

#include "base/angle.h"
#include "base/hash.h"
#include "base/triangle_points.h"

namespace hrad {
namespace {

constexpr int pattern_count = 256;

// The sub-triangle `part` (0..15: quarter, then quarter of the quarter) of the unit triangle.
Node sixteenth(int part) { return child_place(child_place(Node{}, part / 4), part % 4); }

// order[0..3]: a permutation of 0..3 that the hash picks.
void permutation(uint64_t hash, int order[4]) {
  for (int k = 0; k < 4; ++k) order[k] = k;
  for (int k = 3; k > 0; --k) {
    const int other = static_cast<int>(hash % static_cast<uint64_t>(k + 1));
    hash /= static_cast<uint64_t>(k + 1);
    const int swapped = order[k];
    order[k] = order[other];
    order[other] = swapped;
  }
}

PairPoints make_pattern(int number) {
  PairPoints p;
  const uint64_t seed = mix(static_cast<uint64_t>(number), 0x7061697273u);
  int shift[4], within[4];
  permutation(mix(seed, 1), shift);
  permutation(mix(seed, 2), within);
  for (int k = 0; k < 16; ++k) {
    const int quarter = k / 4, turn = k % 4;
    const uint64_t h = mix(seed, static_cast<uint64_t>(k) + 3);
    // Pair (quarter, turn): the source's quarter is a Latin square of both; its sixteenth differs
    // for every quarter of the receiver, so that all sixteen parts are met once on both sides.
    const int source_quarter = shift[(quarter + turn) % 4];
    const int source_part = 4 * source_quarter + within[quarter];
    p.source_part[k] = static_cast<int8_t>(source_part);
    point_in_place(sixteenth(k), unit_interval(mix(h, 1)), unit_interval(mix(h, 2)),
                   &p.receiver_u[k], &p.receiver_v[k]);
    point_in_place(sixteenth(source_part), unit_interval(mix(h, 3)), unit_interval(mix(h, 4)),
                   &p.source_u[k], &p.source_v[k]);
  }
  return p;
}

struct FloatTriangle {
  float ax, ay, az, ux, uy, uz, vx, vy, vz, nx, ny, nz;
};

// Corner, edges and normal in single precision, relative to the center and moved off the surface.
FloatTriangle lifted(const Element& e, Vec3 center, double offset) {
  const Vec3 a = e.corners.a - center + e.normal * offset;
  const Vec3 u = e.corners.b - e.corners.a, v = e.corners.c - e.corners.a;
  const auto f = [](double x) { return static_cast<float>(x); };
  return {f(a.x), f(a.y), f(a.z), f(u.x),        f(u.y),        f(u.z),
          f(v.x), f(v.y), f(v.z), f(e.normal.x), f(e.normal.y), f(e.normal.z)};
}

}  // namespace

void point_in_place(const Node& place, double a, double b, float* u, float* v) {
  fold_into_triangle(a, b);
  double root_u, root_v;
  root_coordinates(place, a, b, &root_u, &root_v);
  *u = static_cast<float>(root_u);
  *v = static_cast<float>(root_v);
}

const PairPoints& pattern_of(uint64_t key) {
  static const std::vector<PairPoints> patterns = [] {
    std::vector<PairPoints> made;
    for (int k = 0; k < pattern_count; ++k) made.push_back(make_pattern(k));
    return made;
  }();
  return patterns[mix(key) % pattern_count];
}

void draw_pairs(const Element& receiver, const Element& source, uint64_t key, Vec3 center,
                double offset, PairSamples& samples) {
  place_pairs(receiver, source, pattern_of(key), center, offset, samples);
}

void place_pairs(const Element& receiver, const Element& source, const PairPoints& p, Vec3 center,
                 double offset, PairSamples& samples) {
  const FloatTriangle r = lifted(receiver, center, offset), s = lifted(source, center, offset);
  SegmentPacket& packet = samples.packet;
  packet.active = all_pairs;
  for (int k = 0; k < 16; ++k) {
    const float ru = p.receiver_u[k], rv = p.receiver_v[k];
    const float su = p.source_u[k], sv = p.source_v[k];
    const float x = r.ax + ru * r.ux + rv * r.vx;
    const float y = r.ay + ru * r.uy + rv * r.vy;
    const float z = r.az + ru * r.uz + rv * r.vz;
    const float dx = s.ax + su * s.ux + sv * s.vx - x;
    const float dy = s.ay + su * s.uy + sv * s.vy - y;
    const float dz = s.az + su * s.uz + sv * s.vz - z;
    packet.ox[k] = x;
    packet.oy[k] = y;
    packet.oz[k] = z;
    packet.dx[k] = dx;
    packet.dy[k] = dy;
    packet.dz[k] = dz;
    float at_receiver = dx * r.nx + dy * r.ny + dz * r.nz;
    float at_source = -(dx * s.nx + dy * s.ny + dz * s.nz);
    at_receiver = at_receiver > 0 ? at_receiver : 0;
    at_source = at_source > 0 ? at_source : 0;
    const float d2 = dx * dx + dy * dy + dz * dz;
    samples.kernel[k] = kernel_of(at_receiver, at_source, d2);
  }
}

void pair_points(uint64_t key, int k, double receiver_uv[2], double source_uv[2]) {
  const PairPoints& p = pattern_of(key);
  receiver_uv[0] = p.receiver_u[k];
  receiver_uv[1] = p.receiver_v[k];
  source_uv[0] = p.source_u[k];
  source_uv[1] = p.source_v[k];
}

void spread_point(uint64_t key, int k, double uv[2]) {
  double unused[2];
  pair_points(key, k, uv, unused);
}

}  // namespace hrad
