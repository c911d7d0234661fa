// Form factors without occlusion: Lambert's formula from a point to a polygon, clipped at the
// horizon (Cohen and Wallace 1993, Section 4.4; Lambert 1760). Floor 6 (links).
#pragma once

#include "base/vec3.h"

namespace hrad {

// The share of the hemisphere over x, weighted by the cosine to `normal` (of length 1), that the
// front-facing triangle covers: the form factor from a differential area at x to the triangle. What
// lies behind the horizon of x doesn't count, nor does a triangle whose back is seen. 0 to 1, error
// below 1e-9 for sources wider than 1e-4 of their distance.
double point_to_triangle(Vec3 x, Vec3 normal, const Triangle& source);

}  // namespace hrad
