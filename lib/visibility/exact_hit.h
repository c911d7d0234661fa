// Where a ray meets the plane of a patch, in double precision: what engines in single precision
// report once they know the patch. Floor 4 (visibility).
#pragma once

#include "base/vec3.h"
#include "scene/scene.h"
#include "visibility/visibility.h"

namespace hrad {

// The place along the ray; not finite for a ray within the plane.
double exact_distance(const Triangle& triangle, Vec3 origin, Vec3 direction);

// The complete hit. single_t stands in where the plane has no point on the ray. u and v are kept
// within the triangle, whose edges an engine sees with rounding.
Hit exact_hit(const Scene& scene, int64_t patch, Vec3 origin, Vec3 direction, double single_t);

}  // namespace hrad
