// A triangle as the picture sees it (footprint.h). CLI: public headers only.
#include "render/footprint.h"

#include <limits>

namespace hrad::cli {

bool make_footprint(const std::array<Vector3, 3>& corners, double near, Footprint* footprint) {
  const double least = std::min({corners[0].z, corners[1].z, corners[2].z});
  const double most = std::max({corners[0].z, corners[1].z, corners[2].z});
  if (!(most > near)) return false;
  // Neighbours get the same edge with the opposite sign, bit by bit: no sample falls between them.
  for (size_t k = 0; k < 3; ++k)
    footprint->edge[k] = cross(corners[(k + 1) % 3], corners[(k + 2) % 3]);
  const double determinant = dot(corners[0], footprint->edge[0]);
  if (determinant == 0 || !std::isfinite(determinant)) return false;
  footprint->front = determinant < 0;
  if (footprint->front)
    for (Vector3& edge : footprint->edge) edge = -1.0 * edge;
  const Vector3 sum = footprint->edge[0] + footprint->edge[1] + footprint->edge[2];
  footprint->inverse_depth = (1 / std::fabs(determinant)) * sum;
  footprint->nearest = 1 / std::max(least, near);
  footprint->farthest = 1 / most;
  return true;
}

bool make_pixel_box(const std::array<Vector3, 3>& corners, double near, const View& view,
                    const PictureSize& size, PixelBox* box) {
  double left = std::numeric_limits<double>::infinity(), right = -left, top = left, bottom = -left;
  const auto include = [&](const Vector3& p) {
    const double i = p.x / p.z + view.middle_i(), j = p.y / p.z + view.middle_j();
    left = std::min(left, i);
    right = std::max(right, i);
    top = std::min(top, j);
    bottom = std::max(bottom, j);
  };
  for (size_t k = 0; k < 3; ++k) {
    const Vector3 &a = corners[k], &b = corners[(k + 1) % 3];
    if (a.z >= near) include(a);
    // Where the edge passes the near plane.
    if ((a.z < near) != (b.z < near)) {
      Vector3 crossing = a + ((near - a.z) / (b.z - a.z)) * (b - a);
      crossing.z = near;
      include(crossing);
    }
  }
  constexpr double margin = 1e-6;  // pixels; what rounding may take from the box
  const auto first = [&](double edge, int end) {
    return static_cast<int>(std::floor(std::max(0.0, std::min(edge - margin, double(end)))));
  };
  const auto past = [&](double edge, int end) {
    return static_cast<int>(std::ceil(std::max(0.0, std::min(edge + margin, double(end)))));
  };
  *box = {first(left, size.width), past(right, size.width), first(top, size.height),
          past(bottom, size.height)};
  return left <= right && box->first_column < box->past_column && box->first_row < box->past_row;
}

}  // namespace hrad::cli
