// Furniture of the built-in scenes, life-size. Floor 3 (scene).
#include "scene/generate_furniture.h"

#include "base/hash.h"

namespace hrad {
namespace {

// An integer from 0 to limit-1.
int32_t vary(uint64_t seed, uint64_t what, int32_t limit) {
  return static_cast<int32_t>(mix(seed, what) % static_cast<uint64_t>(limit));
}

constexpr int32_t leg = 40, leg_inset = 20, top_thickness = 30;
constexpr int32_t underside = desk_height - top_thickness;

constexpr int32_t case_depth = 300, case_height = 1800, board_thickness = 20;
constexpr int32_t case_back_thickness = 10;
constexpr int32_t board_heights[5] = {100, 520, 940, 1360, 1780};

// A spot for an object on one half (600 x 600) of a desk: its lowest corner, its size, and how much
// larger it may be. The stacked book lies on the first one.
struct DeskSpot {
  GridPoint low, size, spread;
  bool stacked;
};
constexpr DeskSpot desk_spots[desk_object_count / 2] = {
    {{50, 200, 0}, {160, 230, 15}, {15, 20, 25}, false},  // book
    {{270, 220, 0}, {200, 280, 6}, {10, 17, 8}, false},   // notebook
    {{510, 260, 0}, {10, 140, 9}, {2, 20, 2}, false},     // pen
    {{60, 60, 0}, {180, 60, 40}, {30, 10, 10}, false},    // pencil case
    {{50, 200, 0}, {120, 170, 12}, {30, 40, 20}, true},   // second book
    {{310, 60, 0}, {40, 20, 12}, {10, 5, 4}, false},      // eraser
};
constexpr int32_t spot_slack = 10;  // an object is moved by up to this along x and y

GridPoint varied_size(const DeskSpot& spot, uint64_t seed) {
  return {spot.size.x + vary(seed, 1, spot.spread.x + 1),
          spot.size.y + vary(seed, 2, spot.spread.y + 1),
          spot.size.z + vary(seed, 3, spot.spread.z + 1)};
}

}  // namespace

void add_chair(Scene& scene, const Place& place, int32_t wood) {
  constexpr int32_t size = 400, inset = 10, thick = 30, seat = 430, seat_top = 450;
  const auto box = [&](GridPoint low, GridPoint high) { add_box(scene, place, low, high, wood); };
  constexpr int32_t sides[2] = {inset, size - inset - thick};
  for (const int32_t x : sides)
    for (const int32_t y : sides) box({x, y, 0}, {x + thick, y + thick, seat});
  box({0, 0, seat}, {size, size, seat_top});
  for (const int32_t x : sides) {
    box({x + 2, inset + thick, 200}, {x + thick - 2, size - inset - thick, 225});
    box({x, size - thick, seat_top}, {x + thick, size, 850});
  }
  box({inset + thick, size - 25, 650}, {size - inset - thick, size - 5, 830});
}

void add_table(Scene& scene, const Place& place, int32_t width, int32_t depth, int32_t wood) {
  for (const int32_t x : {leg_inset, width - leg_inset - leg})
    for (const int32_t y : {leg_inset, depth - leg_inset - leg})
      add_box(scene, place, {x, y, 0}, {x + leg, y + leg, underside}, wood);
  add_box(scene, place, {0, 0, underside}, {width, depth, desk_height}, wood);
}

void add_desk(Scene& scene, const Place& place, int32_t width, int32_t depth, int32_t wood) {
  add_table(scene, place, width, depth, wood);
  // Both span the front legs from inner side to inner side; the tray touches the panel.
  constexpr int32_t inner = leg_inset + leg, panel_front = 30, panel_back = 45;
  add_box(scene, place, {inner, panel_front, 300}, {width - inner, panel_back, underside}, wood);
  add_box(scene, place, {inner, panel_back, 560}, {width - inner, 380, 575}, wood);
}

void add_bookcase(Scene& scene, const Place& place, int32_t width, int32_t wood) {
  const int32_t inner = width - board_thickness;
  const auto box = [&](GridPoint low, GridPoint high) { add_box(scene, place, low, high, wood); };
  box({0, -case_depth, 0}, {board_thickness, 0, case_height});
  box({inner, -case_depth, 0}, {width, 0, case_height});
  box({board_thickness, -case_back_thickness, 0}, {inner, 0, case_height});
  for (const int32_t z : board_heights)
    box({board_thickness, -case_depth, z}, {inner, -case_back_thickness, z + board_thickness});
}

void add_bookcase_books(Scene& scene, const Place& place, int32_t width, int board, int count,
                        uint64_t seed, const int32_t (&covers)[3]) {
  constexpr int32_t thinnest = 20, spread = 35, largest_gap = 12;
  int32_t x = board_thickness + 30 + vary(seed, 0, width / 3);
  const int32_t z = board_heights[board] + board_thickness;
  for (int book = 0; book < count; ++book) {
    const uint64_t own = mix(seed, static_cast<uint64_t>(book) + 1);
    const int32_t thickness = thinnest + vary(own, 1, spread);
    const int32_t height = 200 + vary(own, 2, 120), depth = 140 + vary(own, 3, 80);
    const int32_t spine = -case_depth + 20 + vary(own, 4, 20);
    add_box(scene, place, {x, spine, z}, {x + thickness, spine + depth, z + height},
            covers[book % 3]);
    // Every other gap is none: books pressed against each other.
    x += thickness + (book % 2) * (3 + vary(own, 5, largest_gap));
  }
}

void add_desk_object(Scene& scene, const Place& desk, int object, uint64_t seed,
                     const int32_t (&covers)[3]) {
  // Objects alternate between the desk's halves.
  const int half = object % 2, kind = object / 2;
  const uint64_t half_seed = mix(seed, static_cast<uint64_t>(half));
  const uint64_t own = mix(half_seed, static_cast<uint64_t>(kind) + 2);
  const DeskSpot& spot = desk_spots[kind];
  const GridPoint size = varied_size(spot, own);
  GridPoint low = spot.low + GridPoint{half * (desk_width / 2), 0, desk_height};
  // The second book lies within the cover of the first: that one is moved and is larger.
  const uint64_t mover = spot.stacked ? mix(half_seed, 2) : own;
  low = low + GridPoint{vary(mover, 4, spot_slack), vary(mover, 5, spot_slack), 0};
  if (spot.stacked) low = low + GridPoint{5, 10, varied_size(desk_spots[0], mover).z};
  add_box(scene, desk, low, low + size, covers[(object + vary(own, 6, 3)) % 3]);
}

}  // namespace hrad
