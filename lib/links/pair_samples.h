// Sixteen pairs of points, one on the receiver and one on the source of a link, with the kernel of
// the radiosity equation between them and the segments that test their visibility: form factor and
// visible fraction come from the same pairs. Floor 6 (links).
#pragma once

#include <cstdint>

#include "base/angle.h"
#include "links/element.h"
#include "visibility/visibility.h"

namespace hrad {

constexpr uint32_t all_pairs = 0xffff;
// One pair in each quarter of the receiver and each quarter of the source.
constexpr uint32_t quick_pairs = 0x1111;

// Where the pairs lie: (u,v) of Triangle::at on receiver and source.
struct PairPoints {
  float receiver_u[16], receiver_v[16], source_u[16], source_v[16];
  int8_t
      source_part[16];  // the sixteenth of the source; pair k starts in sixteenth k of the receiver
};

struct PairSamples {
  SegmentPacket packet;  // pairs 4q .. 4q+3 start in quarter q of the receiver
  float kernel[16];      // cos * cos' / (pi d^2), in 1/unit^2; 0 behind a horizon
};

// The kernel of two points whose cosines, each times the distance, are these, d2 being the square
// of the distance. Step by step, so that nothing leaves the range of single precision in a scene of
// any size that is taken.
inline float kernel_of(float at_receiver, float at_source, float d2) {
  constexpr float least_square = 1e-37f, inverse_pi = static_cast<float>(1 / pi);
  const float inverse = 1 / d2;
  return d2 > least_square ? (at_receiver * inverse) * (at_source * inverse) * inverse_pi : 0;
}

// Draws the pairs from the key's hash: stratified on both sides, so that every quarter of the
// receiver meets every quarter of the source. center, offset: VisibilityEngine's.
void draw_pairs(const Element& receiver, const Element& source, uint64_t key, Vec3 center,
                double offset, PairSamples& samples);

// The same with given points: the pairs as packet, and the kernel between them.
void place_pairs(const Element& receiver, const Element& source, const PairPoints& points,
                 Vec3 center, double offset, PairSamples& samples);

// The points that draw_pairs takes for this key: one in each of the sixteenths on both sides.
const PairPoints& pattern_of(uint64_t key);

// Pair k of that pattern.
void pair_points(uint64_t key, int k, double receiver_uv[2], double source_uv[2]);

// (u,v) of the point of a lattice place at (a,b), both from 0 to 1: the unit square is folded along
// its diagonal, so that even (a,b) give even points.
void point_in_place(const Node& place, double a, double b, float* u, float* v);

// (u,v) of point k of 16 spread over a triangle, one in each of its sixteenths.
void spread_point(uint64_t key, int k, double uv[2]);

}  // namespace hrad
