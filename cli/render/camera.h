// A pinhole camera. CLI: public headers only.
#pragma once

#include <array>

#include "render/vector.h"

namespace hrad::cli {

struct Camera {
  Vector3 eye, look, up;  // look: a point in the middle of the picture
  double fov = 60;        // vertical field of view, degrees
};

struct PictureSize {
  int width = 960, height = 720;
};

// The same camera as axes and scales. In its space x points to the right, y down and z ahead, so
// that (i, j) of the picture, in pixels from the upper left corner, looks along direction(i, j),
// whose z is 1: depth is z.
class View {
 public:
  View(const Camera& camera, const PictureSize& size);

  Vector3 to_camera(const Vector3& point) const {
    const Vector3 p = point - eye_;
    return {dot(p, right_), dot(p, down_), dot(p, ahead_)};
  }
  // Scaled so that shared edges of triangles stay the same numbers: x and y are in pixels at depth
  // 1.
  Vector3 to_pixels(const Vector3& point) const {
    const Vector3 p = to_camera(point);
    return {pixels_per_unit_ * p.x, pixels_per_unit_ * p.y, p.z};
  }
  Vector3 direction(double i, double j) const { return {i - middle_i_, j - middle_j_, 1}; }
  double middle_i() const { return middle_i_; }
  double middle_j() const { return middle_j_; }
  // A direction of the picture in the scene's axes, of length 1.
  Vector3 to_scene(const Vector3& pixel_direction) const;

 private:
  Vector3 eye_, right_, down_, ahead_;
  double middle_i_, middle_j_, pixels_per_unit_;
};

// A camera whose eye is at `look`, or whose `up` is along the way it looks, has no view.
bool has_view(const Camera& camera);

// Half the height of what the picture shows at distance 1.
double half_height_at_one(double fov);

}  // namespace hrad::cli
