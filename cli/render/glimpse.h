// What a camera would see, found by a very small picture: the measure by which viewpoints are
// compared. CLI: public headers only.
#pragma once

#include "render/camera.h"
#include "render/geometry.h"

namespace hrad::cli {

struct Glimpse {
  // Shares of the picture: nothing there, a black side there, something very near.
  double background = 0, black = 0, near = 0;
  double depth = 0;  // mean over what is seen, in diagonals of the scene
  int distinct = 0;  // patches seen from a side that shows something
};

Glimpse take_glimpse(const Geometry& geometry, const Camera& camera, const PictureSize& size);

// All around a point: the share of directions that leave the scene, and that meet black sides.
struct Surroundings {
  double background = 0, black = 0;
};
Surroundings look_around(const Geometry& geometry, const Vector3& eye);

}  // namespace hrad::cli
