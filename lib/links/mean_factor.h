// The form factor from a whole triangle to another: Lambert's formula averaged over points of the
// one, the more of them the nearer the other lies. Floor 6 (links).
#pragma once

#include "base/vec3.h"

namespace hrad {

// Distance from a point to the nearest point of a triangle.
double distance_to_triangle(Vec3 p, const Triangle& t);

struct MeanFactor {
  double mean = 0;        // over `from`, without occlusion
  double error = 0;       // of the mean, estimated
  double half_range = 0;  // half the range among the four quarters of `from`
};

// normal: of `from`, length 1. The number of points follows from the geometry alone, never from
// what they see: a small bright spot that a first few points miss must not pass for darkness.
MeanFactor mean_factor(const Triangle& from, Vec3 normal, const Triangle& to);

}  // namespace hrad
