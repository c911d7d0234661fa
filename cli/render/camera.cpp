// A pinhole camera (camera.h). CLI: public headers only.
#include "render/camera.h"

namespace hrad::cli {
namespace {

constexpr double radians_per_degree = 3.14159265358979323846 / 180;

}  // namespace

View::View(const Camera& camera, const PictureSize& size)
    : eye_(camera.eye),
      ahead_(normalized(camera.look - camera.eye)),
      middle_i_(size.width / 2.0),
      middle_j_(size.height / 2.0),
      pixels_per_unit_(size.height / 2.0 / half_height_at_one(camera.fov)) {
  right_ = normalized(cross(ahead_, normalized(camera.up)));
  down_ = cross(ahead_, right_);
}

Vector3 View::to_scene(const Vector3& pixel_direction) const {
  const double x = pixel_direction.x / pixels_per_unit_, y = pixel_direction.y / pixels_per_unit_;
  return normalized(x * right_ + y * down_ + pixel_direction.z * ahead_);
}

bool has_view(const Camera& camera) {
  const Vector3 ahead = camera.look - camera.eye;
  return length(ahead) > 0 && length(camera.up) > 0 &&
         length(cross(normalized(ahead), normalized(camera.up))) > 1e-6;
}

double half_height_at_one(double fov) { return std::tan(fov / 2 * radians_per_degree); }

}  // namespace hrad::cli
