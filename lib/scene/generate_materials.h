// Materials of the built-in scenes, for any number of bands. Floor 3 (scene).
#pragma once

#include <cstdint>
#include <string>

#include "scene/scene.h"

namespace hrad {

struct Rgb {
  double red = 0, green = 0, blue = 0;
};

// Adds a one-sided material. One band gets the mean of the three channels; more than one repeats
// them in a cycle.
int32_t add_rgb_material(Scene& scene, const std::string& name, Rgb reflectance, Rgb emission = {});

}  // namespace hrad
