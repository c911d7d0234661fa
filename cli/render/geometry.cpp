// Patches by the public functions (geometry.h). CLI: public headers only.
#include "render/geometry.h"

#include <algorithm>
#include <limits>

#include "signals.h"

namespace hrad::cli {
namespace {

constexpr int64_t most_at_once = 65536;

void grow(const Vector3& point, Geometry* geometry) {
  for (int axis = 0; axis < 3; ++axis) {
    component(&geometry->lower, axis) =
        std::min(component(geometry->lower, axis), component(point, axis));
    component(&geometry->upper, axis) =
        std::max(component(geometry->upper, axis), component(point, axis));
  }
}

void add(const hrad_patch& patch, double emission, Geometry* geometry) {
  std::array<Vector3, 3> corners;
  for (size_t k = 0; k < 3; ++k)
    corners[k] = {patch.corners_xyz[3 * k], patch.corners_xyz[3 * k + 1],
                  patch.corners_xyz[3 * k + 2]};
  geometry->corners.push_back(corners);
  geometry->emission.push_back(emission);
  geometry->flags.push_back(
      static_cast<uint8_t>((patch.flags & HRAD_PATCH_DROPPED ? Geometry::dropped : 0) |
                           (patch.flags & HRAD_PATCH_TWO_SIDED ? Geometry::two_sided : 0) |
                           (patch.flags & HRAD_PATCH_BLOCKER ? Geometry::blocker : 0) |
                           (emission > 0 ? Geometry::emitter : 0)));
  if (patch.flags & HRAD_PATCH_DROPPED) return;
  for (const Vector3& corner : corners) grow(corner, geometry);
}

}  // namespace

Geometry fetch_geometry(Session* session) {
  Geometry geometry;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  geometry.lower = {infinity, infinity, infinity};
  geometry.upper = {-infinity, -infinity, -infinity};
  const auto bands = static_cast<size_t>(session->bands());
  const int64_t patches = session->patches();
  std::vector<double> emission;
  for (int64_t first = 0; first < patches; first += most_at_once) {
    const int64_t count = std::min(most_at_once, patches - first);
    emission.resize(static_cast<size_t>(count) * bands);
    check(hrad_query_patches(session->solver(), HRAD_EMISSION, HRAD_FRONT, first, count,
                             emission.data()));
    for (int64_t i = 0; i < count; ++i) {
      hrad_patch patch{};
      patch.struct_size = sizeof patch;
      check(hrad_get_patch(session->solver(), first + i, &patch));
      double sum = 0;
      for (size_t band = 0; band < bands; ++band)
        sum += emission[static_cast<size_t>(i) * bands + band];
      add(patch, sum, &geometry);
    }
    signals::check();
  }
  if (!(geometry.lower.x <= geometry.upper.x)) geometry.lower = geometry.upper = Vector3{};
  return geometry;
}

}  // namespace hrad::cli
