// The automatic camera: inside a closed room a viewpoint from which much is seen and nothing is in
// the way, before an open scene or an object one from which all of it is seen. CLI: public headers
// only.
#pragma once

#include <optional>

#include "render/camera.h"
#include "render/geometry.h"

namespace hrad::cli {

// The axis, 0, 1 or 2, that points up. known: of the scene, as hrad_stats has it; where nobody has
// said it is y, but z where the lamps shine along z and the scene is no higher than wide then.
int find_up_axis(const Geometry& geometry, int32_t known);

// size: of the part of the picture that shows the scene.
Camera choose_camera(const Geometry& geometry, const PictureSize& size, int up_axis,
                     std::optional<double> fov);

}  // namespace hrad::cli
