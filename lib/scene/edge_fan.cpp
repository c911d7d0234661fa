// Orders patches by their angle around an edge. Floor 3 (scene).
#include "scene/edge_fan.h"

#include <algorithm>
#include <cmath>

namespace hrad {

namespace {

// Angles closer than this (in quarter turns) are the same: rounding of patches in one plane that
// are cut into triangles differently.
constexpr double angle_rounding = 1e-9;

struct Direction {
  double angle;  // 0 to 4, growing with the angle from the first patch
  const EdgePatch* patch;
};

// Rises with the angle of (x, y) from the first axis, by one per quarter turn.
double quarter_turns(double x, double y) {
  const double t = y / (std::fabs(x) + std::fabs(y));
  if (x < 0) return 2 - t;
  return y < 0 ? 4 + t : t;
}

std::vector<Direction> directions(Vec3 low, Vec3 high, const std::vector<EdgePatch>& patches) {
  const Vec3 axis = normalized(high - low);
  const auto off_axis = [&](const EdgePatch& p) {
    const Vec3 w = p.apex - low;
    return w - axis * dot(w, axis);
  };
  const Vec3 first = normalized(off_axis(patches[0])), second = cross(axis, first);
  std::vector<Direction> result;
  for (const EdgePatch& p : patches) {
    const Vec3 w = off_axis(p);
    const double angle = quarter_turns(dot(w, first), dot(w, second));
    result.push_back({angle > 4 - angle_rounding ? 0 : angle, &p});
  }
  std::sort(result.begin(), result.end(), [](const Direction& a, const Direction& b) {
    return a.angle != b.angle ? a.angle < b.angle : a.patch->patch < b.patch->patch;
  });
  return result;
}

// Patches at one angle, by their direction along the edge.
struct Step {
  std::vector<int32_t> forward, reversed;
  double angle;
};

std::vector<Step> steps_of(const std::vector<Direction>& directions) {
  std::vector<Step> steps;
  for (const Direction& d : directions) {
    if (steps.empty() || d.angle - steps.back().angle > angle_rounding)
      steps.push_back({{}, {}, d.angle});
    (d.patch->reversed ? steps.back().reversed : steps.back().forward).push_back(d.patch->patch);
  }
  return steps;
}

}  // namespace

bool pair_around_edge(Vec3 low, Vec3 high, const std::vector<EdgePatch>& patches,
                      std::vector<std::pair<int32_t, int32_t>>& pairs) {
  const std::vector<Step> steps = steps_of(directions(low, high, patches));
  // With growing angle a solid begins at a reversed patch and ends at a forward one. Whether one
  // has begun before the first step is told by the first step that is out of balance. Without one,
  // all coincide in twos: then there is solid on either side of them rather than between them.
  bool in_solid = true;
  for (const Step& s : steps)
    if (s.forward.size() != s.reversed.size()) {
      in_solid = s.forward.size() > s.reversed.size();
      break;
    }
  std::vector<int32_t> begins, ends;
  const bool in_solid_at_first = in_solid;
  for (const Step& s : steps) {
    const size_t forward = s.forward.size(), reversed = s.reversed.size();
    if (forward > reversed + (in_solid ? 1 : 0) || reversed > forward + (in_solid ? 0 : 1))
      return false;
    begins.insert(begins.end(), s.reversed.begin(), s.reversed.end());
    ends.insert(ends.end(), s.forward.begin(), s.forward.end());
    if (forward != reversed) in_solid = !in_solid;
  }
  if (begins.size() != ends.size()) return false;
  // The first end belongs to the last beginning if the first step lies in a solid.
  const size_t n = begins.size(), shift = in_solid_at_first ? 1 : 0;
  for (size_t i = 0; i < n; ++i) pairs.emplace_back(begins[i], ends[(i + shift) % n]);
  return true;
}

}  // namespace hrad
