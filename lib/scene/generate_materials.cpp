// Materials of the built-in scenes, for any number of bands. Floor 3 (scene).
#include "scene/generate_materials.h"

#include <utility>
#include <vector>

namespace hrad {
namespace {

std::vector<double> band_values(int bands, Rgb rgb) {
  if (bands == 1) return {(rgb.red + rgb.green + rgb.blue) / 3};
  const double channels[3] = {rgb.red, rgb.green, rgb.blue};
  std::vector<double> values(bands);
  for (int band = 0; band < bands; ++band) values[band] = channels[band % 3];
  return values;
}

}  // namespace

int32_t add_rgb_material(Scene& scene, const std::string& name, Rgb reflectance, Rgb emission) {
  Material material;
  material.name = name;
  material.reflectance = band_values(scene.bands, reflectance);
  material.emission = band_values(scene.bands, emission);
  return scene.add_material(std::move(material));
}

}  // namespace hrad
