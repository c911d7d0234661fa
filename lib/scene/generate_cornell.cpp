// The Cornell box after its published measurements (Cornell University Program of Computer
// Graphics), in three bands, turned so that z is up and the open front faces -y; red stands at the
// left of who looks in. Floor 3 (scene).
#include <array>
#include <cstdint>
#include <map>

#include "scene/generate.h"
#include "scene/generate_materials.h"

namespace hrad {
namespace {

// Tenths of the published millimetres, in the published axes: y up, z away from the viewer, x to
// the left.
using Published = std::array<int32_t, 3>;
using Quad = std::array<Published, 4>;

class Drawing {
 public:
  explicit Drawing(Scene& scene) : scene_(scene) {}
  // Anticlockwise seen from the front. Corners are shared within one solid.
  void add(const Quad& quad, int32_t material) {
    std::array<int32_t, 4> v;
    for (int i = 0; i < 4; ++i) v[i] = vertex(quad[i]);
    scene_.add_patch(v[0], v[1], v[2], material);
    scene_.add_patch(v[0], v[2], v[3], material);
  }
  void begin_solid() { vertex_of_.clear(); }

 private:
  int32_t vertex(const Published& p) {
    const auto [found, is_new] = vertex_of_.try_emplace(p, 0);
    if (is_new)
      found->second = scene_.add_vertex({(5560 - p[0]) / 10000.0, p[2] / 10000.0, p[1] / 10000.0});
    return found->second;
  }
  Scene& scene_;
  std::map<Published, int32_t> vertex_of_;
};

// The block over a floor quadrilateral, which runs as published: anticlockwise seen from above.
void add_block(Drawing& drawing, const std::array<std::array<int32_t, 2>, 4>& base, int32_t height,
               int32_t material) {
  drawing.begin_solid();
  Quad bottom, top;
  for (int i = 0; i < 4; ++i) {
    bottom[i] = {base[i][0], 0, base[i][1]};
    top[i] = {base[i][0], height, base[i][1]};
  }
  drawing.add(top, material);
  drawing.add({bottom[3], bottom[2], bottom[1], bottom[0]}, material);
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    drawing.add({bottom[i], bottom[next], top[next], top[i]}, material);
  }
}

}  // namespace

void generate_cornell(Scene& scene, int) {
  const int32_t white = add_rgb_material(scene, "white", {.725, .71, .68});
  const int32_t red = add_rgb_material(scene, "red", {.63, .065, .05});
  const int32_t green = add_rgb_material(scene, "green", {.14, .45, .091});
  const int32_t light = add_rgb_material(scene, "light", {.78, .78, .78}, {17, 12, 4});

  const Published floor_front_left{5528, 0, 0}, floor_front_right{0, 0, 0};
  const Published floor_back_right{0, 0, 5592}, floor_back_left{5496, 0, 5592};
  const Published top_front_left{5560, 5488, 0}, top_front_right{0, 5488, 0};
  const Published top_back_right{0, 5488, 5592}, top_back_left{5560, 5488, 5592};
  Drawing drawing(scene);
  drawing.add({floor_front_left, floor_front_right, floor_back_right, floor_back_left}, white);
  drawing.add({top_front_left, top_back_left, top_back_right, top_front_right}, white);
  drawing.add({floor_back_left, floor_back_right, top_back_right, top_back_left}, white);
  drawing.add({floor_back_right, floor_front_right, top_front_right, top_back_right}, green);
  drawing.add({floor_front_left, floor_back_left, top_back_left, top_front_left}, red);

  constexpr int32_t light_height = 5388;
  drawing.begin_solid();
  drawing.add({Published{3430, light_height, 2270}, Published{3430, light_height, 3320},
               Published{2130, light_height, 3320}, Published{2130, light_height, 2270}},
              light);
  add_block(drawing, {{{1300, 650}, {820, 2250}, {2400, 2720}, {2900, 1140}}}, 1650, white);
  add_block(drawing, {{{4230, 2470}, {2650, 2960}, {3140, 4560}, {4720, 4060}}}, 3300, white);
}

}  // namespace hrad
