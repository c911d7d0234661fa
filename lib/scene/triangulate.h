// Cuts a polygon into triangles without new vertices. Floor 3 (scene).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/span.h"
#include "base/vec3.h"

namespace hrad {

// Appends triangles of corner numbers of the polygon (three corners or more), all with its
// orientation. A convex polygon becomes a fan around its first corner; a concave one is cut by ear
// clipping in its plane (that of its vector area: Newell's normal), also one with holes that are
// joined to its outline by a bridge. False when the polygon has no area or crosses itself: then the
// triangles are a fan. Corners of a concave polygon that stick out as lines without area get no
// triangle.
bool triangulate(Span<const Vec3> polygon, std::vector<std::array<int32_t, 3>>& triangles);

}  // namespace hrad
