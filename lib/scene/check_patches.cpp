// Finds the patches that can't take part: those without area and those that repeat an earlier one.
// Floor 3 (scene).
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "base/error.h"
#include "scene/load.h"
#include "scene/weld.h"

namespace hrad {

namespace {

// Twice the area of a triangle below which it counts as none, relative to its longest edge squared:
// the rounding of the cross product, with two digits to spare.
constexpr double area_rounding = 1e-14;
// The same for the rounding of its coordinates, relative to their magnitude times the longest edge:
// corners on a line far from the origin are on that line only to the last bit of each coordinate.
constexpr double coordinate_rounding = 4 * 2.220446049250313e-16;
// An edge of this many scene radii is a point.
constexpr double point_size = 1e-12;

double magnitude(Vec3 v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }

bool has_no_area(const Triangle& t, double scene_radius) {
  const double longest = std::max({length(t.b - t.a), length(t.c - t.b), length(t.a - t.c)});
  if (longest <= point_size * scene_radius) return true;
  const double reach = std::max({magnitude(t.a), magnitude(t.b), magnitude(t.c)});
  return length(t.area_vector()) <=
         longest * std::max(area_rounding * longest, coordinate_rounding * reach);
}

// A patch by its positions, lowest one first: those with equal low, middle and high are the same
// triangle, and `reversed` says which of the two ways round.
struct Entry {
  int32_t low, middle, high;
  bool reversed;
  int32_t patch;

  auto place() const { return std::tie(low, middle, high); }
  bool operator<(const Entry& other) const {
    return std::tie(low, middle, high, reversed, patch) <
           std::tie(other.low, other.middle, other.high, other.reversed, other.patch);
  }
};

Entry entry(std::array<int32_t, 3> corners, int32_t patch) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return {corners[0], std::min(corners[1], corners[2]), std::max(corners[1], corners[2]),
          corners[1] > corners[2], patch};
}

// One pair of patches, the lowest found so far, and how many there are.
struct Pairs {
  int64_t count = 0, patch = 0, earlier = 0;

  void add(int64_t first, int64_t second) {
    if (count++ == 0 || second < patch) {
      earlier = first;
      patch = second;
    }
  }
};

void drop_without_area(Scene& scene, int64_t first) {
  const Box box = scene.bounds();
  const double radius = box.empty() ? 0 : 0.5 * length(box.extent());
  int64_t count = 0, example = 0;
  for (int64_t i = first; i < scene.patch_count(); ++i) {
    if (!has_no_area(scene.triangle(i), radius)) continue;
    scene.flags[i] |= patch_dropped;
    if (count++ == 0) example = i;
  }
  if (count)
    scene.diagnostics.push_back(
        format("%lld patches without area are dropped (first: patch %lld, face %lld)",
               static_cast<long long>(count), static_cast<long long>(example),
               static_cast<long long>(scene.face[example])));
}

void drop_repetitions(Scene& scene, int64_t first) {
  const std::vector<int32_t> position = weld(scene.vertices);
  std::vector<Entry> entries;
  entries.reserve(scene.corners.size());
  for (int64_t i = 0; i < scene.patch_count(); ++i) {
    const auto& c = scene.corners[i];
    if (!scene.has(i, patch_dropped))
      entries.push_back(
          entry({position[c[0]], position[c[1]], position[c[2]]}, static_cast<int32_t>(i)));
  }
  std::sort(entries.begin(), entries.end());

  Pairs repetitions, sheets;
  for (size_t begin = 0, end; begin < entries.size(); begin = end) {
    // The first of each way round stays; the others go.
    size_t other = begin;  // where the other way round begins
    for (end = begin; end < entries.size() && entries[end].place() == entries[begin].place();
         ++end) {
      if (entries[end].reversed == entries[begin].reversed) other = end + 1;
      const size_t kept = end < other ? begin : other;
      if (end == kept || entries[end].patch < first) continue;
      scene.flags[entries[end].patch] |= patch_dropped;
      repetitions.add(entries[kept].patch, entries[end].patch);
    }
    if (other == end) continue;
    const auto [earlier, later] = std::minmax(entries[begin].patch, entries[other].patch);
    if (later >= first) sheets.add(earlier, later);
  }
  if (repetitions.count)
    scene.diagnostics.push_back(
        format("%lld patches that repeat an earlier one are dropped (first: patch %lld, as %lld)",
               static_cast<long long>(repetitions.count), static_cast<long long>(repetitions.patch),
               static_cast<long long>(repetitions.earlier)));
  if (sheets.count)
    scene.diagnostics.push_back(
        format("%lld pairs of coincident patches of opposite winding (sheets; first: patches %lld "
               "and %lld)",
               static_cast<long long>(sheets.count), static_cast<long long>(sheets.earlier),
               static_cast<long long>(sheets.patch)));
}

}  // namespace

void check_patches(Scene& scene, int64_t first) {
  drop_without_area(scene, first);
  drop_repetitions(scene, first);
}

}  // namespace hrad
