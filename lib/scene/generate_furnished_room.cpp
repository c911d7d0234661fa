// A small realistic closed room for tests of accuracy. Floor 3 (scene).
#include <cstdint>

#include "base/hash.h"
#include "scene/generate.h"
#include "scene/generate_furniture.h"
#include "scene/generate_materials.h"
#include "scene/generate_solids.h"

namespace hrad {

void generate_furnished_room(Scene& scene, int) {
  constexpr GridPoint size{4800, 3600, 2700};
  const int32_t wall = add_rgb_material(scene, "wall", {.70, .67, .60});
  const int32_t warm_wall = add_rgb_material(scene, "wall-warm", {.66, .40, .28});
  const int32_t floor = add_rgb_material(scene, "floor", {.38, .30, .22});
  const int32_t ceiling = add_rgb_material(scene, "ceiling", {.80, .80, .78});
  const int32_t wood = add_rgb_material(scene, "wood", {.44, .31, .19});
  const int32_t dark_wood = add_rgb_material(scene, "wood-dark", {.28, .18, .11});
  const int32_t housing = add_rgb_material(scene, "lamp-housing", {.75, .75, .75});
  const int32_t light = add_rgb_material(scene, "light", {.75, .75, .75}, {90, 82, 68});
  const int32_t covers[3] = {add_rgb_material(scene, "cover-red", {.50, .10, .08}),
                             add_rgb_material(scene, "cover-green", {.12, .35, .18}),
                             add_rgb_material(scene, "cover-white", {.72, .70, .64})};

  add_room(scene, {0, 0, 0}, size, {warm_wall, wall, wall, wall, floor, ceiling});
  // Hung 10 cm below the ceiling, over the table.
  add_lamp(scene, {1800, 1200, size.z - 160}, {3000, 1800, size.z - 100}, housing, light);

  add_table(scene, {{1600, 1100, 0}}, 1600, 800, wood);
  add_chair(scene, {{1750, 1720, 0}}, dark_wood);
  add_chair(scene, {{2600, 1740, 0}}, dark_wood);
  add_chair(scene, {{2200, 1260, 0}, true}, dark_wood);
  add_chair(scene, {{3050, 1280, 0}, true}, dark_wood);

  constexpr int32_t bookcase_width = 1200;
  const Place bookcase{{600, size.y - 20, 0}};
  add_bookcase(scene, bookcase, bookcase_width, wood);
  for (int board = 0; board < 3; ++board)
    add_bookcase_books(scene, bookcase, bookcase_width, board, 4, mix(static_cast<uint64_t>(board)),
                       covers);
  // A sideboard in the corner, pressed to both walls, and a box on it.
  const Place room;
  add_box(scene, room, {size.x - 450, 0, 0}, {size.x, 1500, 800}, dark_wood);
  add_box(scene, room, {size.x - 350, 400, 800}, {size.x - 100, 700, 1000}, covers[2]);
}

}  // namespace hrad
