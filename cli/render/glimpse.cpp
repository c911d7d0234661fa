// Very small pictures (glimpse.h). CLI: public headers only.
#include "render/glimpse.h"

#include <set>

#include "render/raster.h"
#include "signals.h"

namespace hrad::cli {
namespace {

constexpr int glimpse_width = 96;
constexpr double near_share = 0.2;  // of the box's shortest side: what is nearer spoils a view

}  // namespace

Glimpse take_glimpse(const Geometry& geometry, const Camera& camera, const PictureSize& size) {
  signals::check();
  const PictureSize small{glimpse_width, std::max(1, glimpse_width * size.height / size.width)};
  const Raster raster(geometry, camera, small, Backs::black, one_sample(), small.height);
  Visible visible;
  raster.draw(0, &visible);
  Glimpse glimpse;
  std::set<int32_t> distinct;
  const double share = 1.0 / static_cast<double>(visible.patch.size());
  double seen = 0;
  const Vector3 box = geometry.upper - geometry.lower;
  const double near = near_share * std::min({box.x, box.y, box.z});
  for (size_t sample = 0; sample < visible.patch.size(); ++sample) {
    const int32_t patch = visible.patch[sample];
    if (patch == Visible::nothing) {
      glimpse.background += share;
      continue;
    }
    const double depth = 1 / visible.inverse_depth[sample];
    glimpse.near += depth < near ? share : 0;
    glimpse.depth += depth / geometry.diagonal();
    seen += 1;
    if (geometry.is_black(patch, visible.front[sample] != 0))
      glimpse.black += share;
    else
      distinct.insert(patch);
  }
  if (seen > 0) glimpse.depth /= seen;
  glimpse.distinct = static_cast<int>(distinct.size());
  return glimpse;
}

Surroundings look_around(const Geometry& geometry, const Vector3& eye) {
  Surroundings around;
  const double distance = geometry.diagonal();
  for (int axis = 0; axis < 3; ++axis)
    for (double way : {-distance, distance}) {
      const Camera camera{eye, eye + axis_vector(axis, way), axis_vector((axis + 1) % 3), 90};
      const Glimpse glimpse = take_glimpse(geometry, camera, {1, 1});
      around.background += glimpse.background / 6;
      around.black += glimpse.black / 6;
    }
  return around;
}

}  // namespace hrad::cli
