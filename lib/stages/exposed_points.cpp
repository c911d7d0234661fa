// Points on the exposed part of an element some of whose corners are sealed. Floor 7 (stages).
#include <algorithm>
#include <cmath>

#include "links/element.h"
#include "links/pair_samples.h"
#include "stages/corner_light.h"

namespace hrad {
namespace {

constexpr int tries_for_an_exposed_point = 64;
constexpr int steps_to_a_border = 8;
constexpr double least_length = 1e-150;  // whose square is a number

// Three points that have the mean of every quadratic field over a trapezoid whose parallel sides
// run from a to b and from a_far to b_far: its centroid and second moments are theirs.
void points_of_trapezoid(Vec3 a, Vec3 b, Vec3 a_far, Vec3 b_far, Vec3 place[3]) {
  const Vec3 near = (a + b) * 0.5, far = (a_far + b_far) * 0.5, height = far - near;
  const double near_half = length(b - a) / 2, far_half = length(b_far - a_far) / 2;
  // Two points, to rounding, have no length that a share could be of.
  const double sum = std::max(near_half + far_half, least_length);
  const Vec3 middle = near + height * ((near_half + 2 * far_half) / (3 * sum));
  const Vec3 along = near_half > 0 ? (b - a) * (1 / (2 * near_half)) : Vec3{0, 0, 0};
  const double across = std::sqrt(1 + 2 * near_half * far_half / (sum * sum)) / 6;
  const double beside = std::sqrt(near_half * near_half + far_half * far_half) / 2;
  place[0] = middle - height * across - along * beside;
  place[1] = middle - height * across + along * beside;
  place[2] = middle + height * (2 * across);
}

}  // namespace

// The last exposed point on the way.
Vec3 CornerSampler::border(int32_t surface, Vec3 exposed, Vec3 sealed) const {
  for (int k = 0; k < steps_to_a_border; ++k) {
    const Vec3 between = (exposed + sealed) * 0.5;
    (is_sealed(surface, between) ? sealed : exposed) = between;
  }
  return exposed;
}

bool CornerSampler::points_of_exposed(NodeId id, const LatticePoint corner[3],
                                      Vec3 place[3]) const {
  const Node& node = state_.forest.nodes[id];
  const int32_t surface = node.surface;
  Vec3 open[3], shut[3];
  int exposed = 0, sealed = 0;
  for (int c = 0; c < 3; ++c) {
    const Vec3 on = point_of(surface, corner[c]), within = moved_inwards(surface, on);
    if (is_sealed(surface, within))
      shut[sealed++] = on;
    else
      open[exposed++] = within;
  }
  if (exposed == 1 || exposed == 3) {
    const Vec3 triangle[3] = {open[0], exposed == 3 ? open[1] : border(surface, open[0], shut[0]),
                              exposed == 3 ? open[2] : border(surface, open[0], shut[1])};
    const Vec3 middle = (triangle[0] + triangle[1] + triangle[2]) * (1.0 / 3);
    for (int c = 0; c < 3; ++c) place[c] = (triangle[c] + middle) * 0.5;
  } else if (exposed == 2) {
    points_of_trapezoid(open[0], open[1], border(surface, open[0], shut[0]),
                        border(surface, open[1], shut[0]), place);
  }
  Vec3 somewhere;
  bool found = false;
  for (int c = 0; c < 3; ++c) {
    if (exposed > 0 && !is_sealed(surface, place[c])) continue;
    if (!found && !exposed_within(node, &somewhere)) return false;
    found = true;
    place[c] = somewhere;
  }
  return true;
}

bool CornerSampler::exposed_within(const Node& node, Vec3* place) const {
  const Triangle corners = state_.forest.triangle(node);
  const uint64_t key = mix(key_of(state_.forest, node), seed_, 0x77697468u);
  for (int k = 0; k < tries_for_an_exposed_point; ++k) {
    double uv[2];
    spread_point(mix(key, static_cast<uint64_t>(k / 16)), k % 16, uv);
    *place = corners.at(uv[0], uv[1]);
    if (!is_sealed(node.surface, *place)) return true;
  }
  return false;
}

}  // namespace hrad
