// A right-handed frame around a normal, and cosine-distributed directions in it. Floor 1 (base).
#pragma once

#include "base/angle.h"
#include "base/vec3.h"

namespace hrad {

struct Frame {
  Vec3 tangent, bitangent, normal;

  // normal has length 1. Without branches on nearly equal components (Duff et al., "Building an
  // Orthonormal Basis, Revisited", JCGT 2017).
  explicit Frame(Vec3 n) : normal(n) {
    const double sign = n.z >= 0 ? 1.0 : -1.0;
    const double a = -1 / (sign + n.z), b = n.x * n.y * a;
    tangent = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    bitangent = {b, sign + n.y * n.y * a, -n.y};
  }

  // The direction with density cos/pi that belongs to the point (u,v) of the unit square.
  Vec3 cosine_direction(double u, double v) const {
    const Turn turn = turn_of(v);
    const double radius = std::sqrt(u);
    return tangent * (radius * turn.cosine) + bitangent * (radius * turn.sine) +
           normal * std::sqrt(1 - u);
  }
};

}  // namespace hrad
