// The scene Building of the paper (section 4): many identical furnished rooms joined by door
// openings through which light passes. Floor 3 (scene).
#include <cstdint>

#include "scene/generate.h"
#include "scene/generate_materials.h"
#include "scene/generate_polyhedron.h"
#include "scene/generate_solids.h"

namespace hrad {
namespace {

// Inner measures of a room; rooms repeat with the pitch, walls and slabs between them.
constexpr GridPoint room_size{5000, 4000, 3000};
constexpr int32_t wall_thickness = 200, slab_thickness = 300;
constexpr GridPoint pitch{room_size.x + wall_thickness, room_size.y + wall_thickness,
                          room_size.z + slab_thickness};
// Where a door opening begins along its wall, in a room's own coordinates.
constexpr int32_t door_width = 900, door_height = 2100;
constexpr int32_t door_in_east_wall = 2800, door_in_north_wall = 3700;

// A room has 12 triangles of its own and 108 of lamp and furniture, an opening adds 20 to the two
// rooms that it joins: 6 openings for 5 rooms make 144 triangles a room.
struct Layout {
  int columns, rows, storeys;
  int openings_per_storey() const { return columns * rows * 6 / 5; }
  // Rooms of a row are all joined; of the walls between rows, the rest of the openings is spread
  // evenly over them.
  bool opens_east(int column) const { return column + 1 < columns; }
  bool opens_north(int column, int row) const {
    if (row < 0 || row + 1 >= rows) return false;
    const int walls = columns * (rows - 1), wall = row * columns + column;
    const int openings = openings_per_storey() - (columns - 1) * rows;
    return (wall + 1) * openings / walls > wall * openings / walls;
  }
};

Layout layout_of(int size) {
  if (size == 1) return {5, 4, 1};
  if (size == 10) return {10, 10, 2};
  return {20, 20, 5};
}

struct Palette {
  int32_t wall, floor, ceiling, door_frame, housing, light, table, chair, cabinet, couch;
};

Palette add_palette(Scene& scene) {
  Palette p;
  p.wall = add_rgb_material(scene, "wall", {.68, .66, .60});
  p.floor = add_rgb_material(scene, "floor", {.36, .30, .24});
  p.ceiling = add_rgb_material(scene, "ceiling", {.78, .78, .76});
  p.door_frame = add_rgb_material(scene, "door-frame", {.55, .50, .42});
  p.housing = add_rgb_material(scene, "lamp-housing", {.75, .75, .75});
  p.light = add_rgb_material(scene, "light", {.75, .75, .75}, {110, 100, 85});
  p.table = add_rgb_material(scene, "table", {.42, .29, .17});
  p.chair = add_rgb_material(scene, "chair", {.25, .32, .40});
  p.cabinet = add_rgb_material(scene, "cabinet", {.50, .38, .25});
  p.couch = add_rgb_material(scene, "couch", {.45, .14, .12});
  return p;
}

GridPoint corner_of_room(int column, int row, int storey) {
  return {column * pitch.x, row * pitch.y, storey * pitch.z};
}

// A wall of a room at `at` on the axis (0 or 1), with an opening from `door` on if door >= 0.
Outline wall(GridPoint low, int axis, int32_t at, bool positive, int32_t door) {
  const int along = 1 - axis;
  const auto corner = [&](int32_t a, int32_t z) {
    return axis == 0 ? GridPoint{at, low.y + a, low.z + z} : GridPoint{low.x + a, at, low.z + z};
  };
  const int32_t width = room_size[along], height = room_size.z;
  if (door < 0)
    return facing({corner(0, 0), corner(width, 0), corner(width, height), corner(0, height)}, axis,
                  positive);
  return facing({corner(0, 0), corner(door, 0), corner(door, door_height),
                 corner(door + door_width, door_height), corner(door + door_width, 0),
                 corner(width, 0), corner(width, height), corner(0, height)},
                axis, positive);
}

// Sill, head and the two jambs of an opening through the wall behind `at` on the axis.
void add_opening(Polyhedron& shell, GridPoint room, int axis, int32_t at, int32_t door,
                 const Palette& p) {
  GridPoint low, high;
  if (axis == 0) {
    low = {at, room.y + door, room.z};
    high = {at + wall_thickness, low.y + door_width, room.z + door_height};
  } else {
    low = {room.x + door, at, room.z};
    high = {low.x + door_width, at + wall_thickness, room.z + door_height};
  }
  const int along = 1 - axis;
  shell.add_face(rectangle(2, low.z, low, high, true), p.floor);
  shell.add_face(rectangle(2, high.z, low, high, false), p.door_frame);
  shell.add_face(rectangle(along, low[along], low, high, true), p.door_frame);
  shell.add_face(rectangle(along, high[along], low, high, false), p.door_frame);
}

// The free space of one storey: a single closed surface seen from within.
void add_storey(Scene& scene, const Layout& layout, int storey, const Palette& p) {
  Polyhedron shell;
  for (int row = 0; row < layout.rows; ++row) {
    for (int column = 0; column < layout.columns; ++column) {
      const GridPoint low = corner_of_room(column, row, storey), high = low + room_size;
      const bool east = layout.opens_east(column), north = layout.opens_north(column, row);
      const bool west = column > 0, south = layout.opens_north(column, row - 1);
      shell.add_face(rectangle(2, low.z, low, high, true), p.floor);
      shell.add_face(rectangle(2, high.z, low, high, false), p.ceiling);
      shell.add_face(wall(low, 0, low.x, true, west ? door_in_east_wall : -1), p.wall);
      shell.add_face(wall(low, 0, high.x, false, east ? door_in_east_wall : -1), p.wall);
      shell.add_face(wall(low, 1, low.y, true, south ? door_in_north_wall : -1), p.wall);
      shell.add_face(wall(low, 1, high.y, false, north ? door_in_north_wall : -1), p.wall);
      if (east) add_opening(shell, low, 0, high.x, door_in_east_wall, p);
      if (north) add_opening(shell, low, 1, high.y, door_in_north_wall, p);
    }
  }
  shell.add_to(scene);
}

// Lamp 12, table 28, chair 40, couch 16, cabinet 12: 108 triangles.
void furnish(Scene& scene, GridPoint room, const Palette& p) {
  const Place place{room};
  // Hung 10 cm below the ceiling.
  add_lamp(scene, room + GridPoint{1900, 1700, 2840}, room + GridPoint{3100, 2300, 2900}, p.housing,
           p.light);
  // A board on two side panels; at its long side a chair whose back leans.
  const Profile table{{0, 0},    {720, 0},    {720, 1520}, {0, 1520},
                      {0, 1560}, {750, 1560}, {750, -40},  {0, -40}};
  extrusion(table, 1, 0, 800, place.at({1720, 1300, 0}), p.table).add_to(scene);
  const Profile chair{{0, 0},     {30, 0},    {30, 420},  {390, 420}, {390, 0}, {420, 0},
                      {420, 450}, {480, 850}, {450, 850}, {390, 450}, {0, 450}};
  extrusion(chair, 0, 0, 420, place.at({2290, 1900, 0}), p.chair).add_to(scene);
  // The couch stands near a wall, the cabinet is pressed to one.
  const Profile couch{{0, 0}, {850, 0}, {850, 420}, {350, 420}, {0, 800}};
  extrusion(couch, 0, 0, 1900, place.at({900, 80, 0}), p.couch).add_to(scene);
  add_box(scene, place, {0, 1100, 0}, {450, 2300, 1900}, p.cabinet);
}

}  // namespace

void generate_building(Scene& scene, int size) {
  const Layout layout = layout_of(size);
  const Palette palette = add_palette(scene);
  for (int storey = 0; storey < layout.storeys; ++storey)
    add_storey(scene, layout, storey, palette);
  for (int storey = 0; storey < layout.storeys; ++storey)
    for (int row = 0; row < layout.rows; ++row)
      for (int column = 0; column < layout.columns; ++column)
        furnish(scene, corner_of_room(column, row, storey), palette);
}

}  // namespace hrad
