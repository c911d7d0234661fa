// Whether two triangles cross each other. Floor 4 (visibility).
#pragma once

#include "base/vec3.h"

namespace hrad {

// The segment from a to b passes through the triangle (Möller, Trumbore 1997), parallel ones
// excepted.
inline bool segment_crosses(Vec3 a, Vec3 b, const Triangle& t) {
  const Vec3 d = b - a, u = t.b - t.a, v = t.c - t.a, from = a - t.a;
  const Vec3 p = cross(d, v);
  const double scale = dot(u, p);
  if (scale == 0) return false;
  const double x = dot(from, p) / scale;
  const Vec3 q = cross(from, u);
  const double y = dot(d, q) / scale, along = dot(v, q) / scale;
  return x >= 0 && y >= 0 && x + y <= 1 && along >= 0 && along <= 1;
}

// An edge of the one passes through the other. Coplanar triangles don't count as crossing.
inline bool triangles_cross(const Triangle& s, const Triangle& t) {
  return segment_crosses(s.a, s.b, t) || segment_crosses(s.b, s.c, t) ||
         segment_crosses(s.c, s.a, t) || segment_crosses(t.a, t.b, s) ||
         segment_crosses(t.b, t.c, s) || segment_crosses(t.c, t.a, s);
}

}  // namespace hrad
