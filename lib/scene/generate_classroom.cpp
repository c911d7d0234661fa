// The scene Classroom of the paper (section 4): one clear room with many polygons that see each
// other. The larger sizes are halls of the same bays, furnished as densely. Floor 3 (scene).
#include <algorithm>
#include <cstdint>

#include "base/error.h"
#include "base/hash.h"
#include "scene/generate.h"
#include "scene/generate_furniture.h"
#include "scene/generate_materials.h"
#include "scene/generate_polyhedron.h"
#include "scene/generate_solids.h"

namespace hrad {
namespace {

constexpr int64_t patches_of_size_1 = 9253;

// The room is a grid of square bays; each has a lamp, and on the left wall (x = 0) a window.
// Blackboards hang on the front wall (y = 0), bookcases stand at the back.
constexpr int32_t bay = 2400, height = 3000;
constexpr int32_t window_low = 900, window_high = 2400, window_start = 500, window_end = 1900;
constexpr int32_t recess = 200;
constexpr int32_t first_desk = 2000, desk_pitch = 1200, last_desk_to_back_wall = 1600;
constexpr int32_t bookcase_width = 1600, bookcase_off_wall = 20;
constexpr int boards_with_books = 4, books_on_a_board = 6;

struct Layout {
  int columns, rows;  // bays
  int pennants;       // single triangles, what makes the number of patches odd in size 1
  int32_t width() const { return columns * bay; }
  int32_t depth() const { return rows * bay; }
  int desk_rows() const { return (depth() - first_desk - last_desk_to_back_wall) / desk_pitch + 1; }
  int desks() const { return columns * desk_rows(); }
  int blackboards() const { return std::max(1, columns / 4); }
  int doors() const { return std::max(1, rows / 5); }
};

Layout layout_of(int size) {
  if (size == 1) return {4, 3, 1};
  if (size == 10) return {15, 7, 10};
  return {35, 30, 100};
}

struct Palette {
  int32_t wall, floor, ceiling, pane, frame, housing, light, desk, chair, bookcase, blackboard,
      chalk, door, metal, bag, pennant;
  int32_t covers[3];
};

Palette add_palette(Scene& scene) {
  Palette p;
  p.wall = add_rgb_material(scene, "wall", {.70, .68, .60});
  p.floor = add_rgb_material(scene, "floor", {.38, .34, .28});
  p.ceiling = add_rgb_material(scene, "ceiling", {.80, .80, .78});
  p.pane = add_rgb_material(scene, "window-pane", {.12, .14, .16});
  p.frame = add_rgb_material(scene, "frame", {.65, .65, .62});
  p.housing = add_rgb_material(scene, "lamp-housing", {.75, .75, .75});
  p.light = add_rgb_material(scene, "light", {.75, .75, .75}, {60, 57, 50});
  p.desk = add_rgb_material(scene, "desk", {.48, .34, .20});
  p.chair = add_rgb_material(scene, "chair", {.40, .28, .17});
  p.bookcase = add_rgb_material(scene, "bookcase", {.52, .42, .30});
  p.blackboard = add_rgb_material(scene, "blackboard", {.05, .09, .07});
  p.chalk = add_rgb_material(scene, "name-plate", {.80, .80, .78});
  p.door = add_rgb_material(scene, "door", {.35, .42, .48});
  p.metal = add_rgb_material(scene, "metal", {.55, .56, .57});
  p.bag = add_rgb_material(scene, "bag", {.14, .18, .34});
  p.covers[0] = add_rgb_material(scene, "cover-red", {.50, .10, .08});
  p.covers[1] = add_rgb_material(scene, "cover-green", {.12, .35, .18});
  p.covers[2] = add_rgb_material(scene, "cover-white", {.72, .70, .64});
  p.pennant = add_rgb_material(scene, "pennant", {.60, .48, .08});
  scene.materials[p.pennant].two_sided = true;
  return p;
}

// The wall of one bay around its window, the recess behind it and the pane.
void add_window_bay(Polyhedron& shell, int row, const Palette& p) {
  const int32_t y0 = row * bay, y1 = y0 + bay, w0 = y0 + window_start, w1 = y0 + window_end;
  const auto on_wall = [&](int32_t ya, int32_t za, int32_t yb, int32_t zb) {
    shell.add_face(rectangle(0, 0, {0, ya, za}, {0, yb, zb}, true), p.wall);
  };
  on_wall(y0, 0, y1, window_low);
  on_wall(y0, window_low, w0, window_high);
  on_wall(w1, window_low, y1, window_high);
  on_wall(y0, window_high, y1, height);
  const GridPoint low{-recess, w0, window_low}, high{0, w1, window_high};
  shell.add_face(rectangle(1, low.y, low, high, true), p.wall);
  shell.add_face(rectangle(1, high.y, low, high, false), p.wall);
  shell.add_face(rectangle(2, low.z, low, high, true), p.wall);
  shell.add_face(rectangle(2, high.z, low, high, false), p.wall);
  shell.add_face(rectangle(0, low.x, low, high, true), p.pane);
}

void add_shell(Scene& scene, const Layout& layout, const Palette& p) {
  Polyhedron shell;
  for (int row = 0; row < layout.rows; ++row) {
    for (int column = 0; column < layout.columns; ++column) {
      const GridPoint low{column * bay, row * bay, 0}, high = low + GridPoint{bay, bay, height};
      shell.add_face(rectangle(2, 0, low, high, true), p.floor);
      shell.add_face(rectangle(2, height, low, high, false), p.ceiling);
    }
  }
  for (int column = 0; column < layout.columns; ++column) {
    const GridPoint low{column * bay, 0, 0}, high{low.x + bay, layout.depth(), height};
    shell.add_face(rectangle(1, low.y, low, high, true), p.wall);
    shell.add_face(rectangle(1, high.y, low, high, false), p.wall);
  }
  for (int row = 0; row < layout.rows; ++row) {
    const GridPoint low{0, row * bay, 0}, high{layout.width(), low.y + bay, height};
    shell.add_face(rectangle(0, high.x, low, high, false), p.wall);
    add_window_bay(shell, row, p);
  }
  shell.add_to(scene);
}

// Pressed to the ceiling, across the middle of each bay.
void add_lamps(Scene& scene, const Layout& layout, const Palette& p) {
  for (int row = 0; row < layout.rows; ++row) {
    for (int column = 0; column < layout.columns; ++column) {
      const GridPoint middle{column * bay + bay / 2, row * bay + bay / 2, height};
      add_lamp(scene, middle + GridPoint{-600, -150, -80}, middle + GridPoint{600, 150, 0},
               p.housing, p.light);
    }
  }
}

// A cross of bars pressed on each pane.
void add_window_frames(Scene& scene, const Layout& layout, const Palette& p) {
  constexpr int32_t back = -recess, front = -recess + 50, half_bar = 20;
  constexpr int32_t middle_z = (window_low + window_high) / 2;
  for (int row = 0; row < layout.rows; ++row) {
    const Place place{{0, row * bay, 0}};
    constexpr int32_t middle = (window_start + window_end) / 2;
    add_box(scene, place, {back, middle - half_bar, window_low},
            {front, middle + half_bar, window_high}, p.frame);
    add_box(scene, place, {back, window_start, middle_z - half_bar},
            {front, middle - half_bar, middle_z + half_bar}, p.frame);
    add_box(scene, place, {back, middle + half_bar, middle_z - half_bar},
            {front, window_end, middle_z + half_bar}, p.frame);
  }
}

Place blackboard_place(const Layout& layout, int number) {
  const int32_t middle = layout.width() * (2 * number + 1) / (2 * layout.blackboards());
  return {{middle, 0, 0}};
}

// A framed board with its chalk ledge on the wall, and the teacher's desk and chair before it.
void add_blackboards(Scene& scene, const Layout& layout, const Palette& p) {
  constexpr int32_t half = 1800, low = 900, high = 2100, bar = 50, thick = 35;
  for (int number = 0; number < layout.blackboards(); ++number) {
    const Place place = blackboard_place(layout, number);
    add_box(scene, place, {-half, 0, low}, {half, 20, high}, p.blackboard);
    add_box(scene, place, {-half - bar, 0, low - bar}, {half + bar, thick, low}, p.frame);
    add_box(scene, place, {-half - bar, 0, high}, {half + bar, thick, high + bar}, p.frame);
    add_box(scene, place, {-half - bar, 0, low}, {-half, thick, high}, p.frame);
    add_box(scene, place, {half, 0, low}, {half + bar, thick, high}, p.frame);
    add_box(scene, place, {-half, thick, low - bar}, {half, thick + 60, low - bar + 15}, p.frame);
    add_desk(scene, place.at({800, 1500, 0}, true), 1600, 700, p.desk);
    add_chair(scene, place.at({200, 850, 0}, true), p.chair);
  }
}

// Folded name plates (triangular prisms of 8 triangles) on the first teacher's desk.
void add_name_plates(Scene& scene, const Layout& layout, int count, const Palette& p) {
  const Profile plate{{0, 0}, {80, 0}, {40, 90}};
  for (int number = 0; number < count; ++number) {
    const Place place = blackboard_place(layout, 0).at({-700 + number * 400, 1300, desk_height});
    extrusion(plate, 0, 0, 250, place, p.chalk).add_to(scene);
  }
}

// Leaf, frame and handle, pressed on the wall at x = width.
void add_doors(Scene& scene, const Layout& layout, const Palette& p) {
  constexpr int32_t width = 900, leaf = 2050, bar = 60;
  for (int number = 0; number < layout.doors(); ++number) {
    const Place place{{layout.width(), 600 + number * 5 * bay, 0}};
    add_box(scene, place, {-30, 0, 0}, {0, width, leaf}, p.door);
    add_box(scene, place, {-50, -bar, 0}, {0, 0, leaf + bar}, p.frame);
    add_box(scene, place, {-50, width, 0}, {0, width + bar, leaf + bar}, p.frame);
    add_box(scene, place, {-50, 0, leaf}, {0, width, leaf + bar}, p.frame);
    add_box(scene, place, {-80, 780, 1020}, {-30, 880, 1050}, p.metal);
  }
}

void add_bookcases(Scene& scene, const Layout& layout, const Palette& p) {
  for (int column = 0; column < layout.columns; ++column) {
    const Place place{
        {column * bay + (bay - bookcase_width) / 2, layout.depth() - bookcase_off_wall, 0}};
    add_bookcase(scene, place, bookcase_width, p.bookcase);
    for (int board = 0; board < boards_with_books; ++board)
      add_bookcase_books(scene, place, bookcase_width, board, books_on_a_board,
                         mix(static_cast<uint64_t>(column), static_cast<uint64_t>(board)),
                         p.covers);
  }
}

// Two-sided, 5 cm off the wall at x = width and above the doors.
void add_pennants(Scene& scene, const Layout& layout, const Palette& p) {
  constexpr int32_t wide = 300, top = 2750, tip = 2300, off_wall = 50;
  const int32_t spacing = layout.depth() / layout.pennants, x = layout.width() - off_wall;
  for (int number = 0; number < layout.pennants; ++number) {
    const int32_t y = number * spacing + spacing / 2;
    const int32_t a = scene.add_vertex(metres({x, y - wide / 2, top}));
    const int32_t b = scene.add_vertex(metres({x, y, tip}));
    const int32_t c = scene.add_vertex(metres({x, y + wide / 2, top}));
    scene.add_patch(a, b, c, p.pennant);
  }
}

Place desk_place(const Layout& layout, int desk) {
  const int column = desk % layout.columns, row = desk / layout.columns;
  return {{column * bay + (bay - desk_width) / 2, first_desk + row * desk_pitch, 0}};
}

// A desk for two, its chairs pushed back more or less, and two bags under it.
void add_desk_set(Scene& scene, const Place& place, uint64_t seed, const Palette& p) {
  add_desk(scene, place, desk_width, desk_depth, p.desk);
  for (int seat = 0; seat < 2; ++seat) {
    const uint64_t own = mix(seed, static_cast<uint64_t>(seat) + 100);
    const int32_t aside = static_cast<int32_t>(own % 41) - 20;
    const int32_t back = static_cast<int32_t>((own >> 16) % 121);
    const int32_t left = seat * (desk_width / 2);
    add_chair(scene, place.at({left + 100 + aside, 480 + back, 0}), p.chair);
    const int32_t bag = left + 150 + aside;
    add_box(scene, place, {bag, 150, 0}, {bag + 280, 290, 300 + aside}, p.bag);
  }
}

// The fill that makes the number of patches exact: books and other things on the desks, as evenly
// as integers allow. One solid alone has fewer than 12 triangles: the name plates.
void fill_desks(Scene& scene, const Layout& layout, int64_t target, const Palette& p) {
  int plates = 0;
  while (plates < 3 && (target - scene.patch_count() - 8 * plates) % 12 != 0) ++plates;
  add_name_plates(scene, layout, plates, p);
  const int64_t left = target - scene.patch_count(), objects = left / 12, desks = layout.desks();
  if (left % 12 != 0 || objects < 0 || objects > desks * desk_object_count)
    fail(Status::internal, "the classroom can't be filled to its number of patches");
  for (int64_t desk = 0; desk < desks; ++desk) {
    const int count = static_cast<int>((desk + 1) * objects / desks - desk * objects / desks);
    for (int object = 0; object < count; ++object)
      add_desk_object(scene, desk_place(layout, static_cast<int>(desk)), object,
                      mix(static_cast<uint64_t>(desk)), p.covers);
  }
}

}  // namespace

void generate_classroom(Scene& scene, int size) {
  const Layout layout = layout_of(size);
  const Palette palette = add_palette(scene);
  add_shell(scene, layout, palette);
  add_lamps(scene, layout, palette);
  add_window_frames(scene, layout, palette);
  add_blackboards(scene, layout, palette);
  add_doors(scene, layout, palette);
  add_bookcases(scene, layout, palette);
  add_pennants(scene, layout, palette);
  for (int desk = 0; desk < layout.desks(); ++desk)
    add_desk_set(scene, desk_place(layout, desk), mix(static_cast<uint64_t>(desk)), palette);
  fill_desks(scene, layout, patches_of_size_1 * size, palette);
}

}  // namespace hrad
