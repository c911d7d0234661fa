// The scene as pictures need it: the corners of its patches and what their sides show. CLI: public
// headers only.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/vector.h"
#include "session.h"

namespace hrad::cli {

struct Geometry {
  enum PatchFlag : uint8_t { dropped = 1, two_sided = 2, blocker = 4, emitter = 8 };

  std::vector<std::array<Vector3, 3>> corners;  // per patch, anticlockwise seen from the front
  std::vector<uint8_t> flags;                   // per patch: PatchFlag
  std::vector<double> emission;                 // per patch: the sum of the bands, W/m2
  Vector3 lower, upper;                         // the box around what is not dropped

  int64_t patches() const { return static_cast<int64_t>(flags.size()); }
  double diagonal() const { return length(upper - lower); }
  Vector3 centre() const { return 0.5 * (lower + upper); }
  bool has(int64_t patch, PatchFlag flag) const {
    return (flags[static_cast<size_t>(patch)] & flag) != 0;
  }
  // Seen from there a side is black by the meaning of sides: the back of a one-sided patch, a
  // blocker.
  bool is_black(int64_t patch, bool front) const {
    return has(patch, blocker) || !(front || has(patch, two_sided));
  }
};

// Emission is that of the present state of the solver; no solve is needed.
Geometry fetch_geometry(Session* session);

}  // namespace hrad::cli
