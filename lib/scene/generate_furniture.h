// Furniture of the built-in scenes, life-size. Every piece is made of closed solids that touch but
// never overlap; it stands with its feet pressed on the floor (z = 0 of its place). Floor 3
// (scene).
#pragma once

#include <cstdint>

#include "scene/generate_solids.h"
#include "scene/scene.h"

namespace hrad {

constexpr int32_t desk_width = 1200, desk_depth = 600, desk_height = 750;

// 10 boxes. Occupies 400 x 400, faces towards -y: the back rest stands at y = 370..400.
void add_chair(Scene& scene, const Place& place, int32_t wood);

// 5 boxes: a top of the given size and four legs, 750 high.
void add_table(Scene& scene, const Place& place, int32_t width, int32_t depth, int32_t wood);

// 7 boxes: the table with a front panel (at -y) and a tray under the top.
void add_desk(Scene& scene, const Place& place, int32_t width, int32_t depth, int32_t wood);

// 8 boxes: an open bookcase 300 deep and 1,800 high; the back (y = 0) may be pressed against a
// wall, the open side faces -y.
void add_bookcase(Scene& scene, const Place& place, int32_t width, int32_t wood);

// Stands `count` books side by side on a board (0..3) of a bookcase of that width. `seed` varies
// their sizes; materials cycle through `covers`.
void add_bookcase_books(Scene& scene, const Place& place, int32_t width, int board, int count,
                        uint64_t seed, const int32_t (&covers)[3]);

// The objects that may lie on a desk, numbered in the order in which a desk fills up: books and
// notebooks first, erasers last. Each is one box in a spot of its own. `seed` varies size and
// place.
constexpr int desk_object_count = 12;
void add_desk_object(Scene& scene, const Place& desk, int object, uint64_t seed,
                     const int32_t (&covers)[3]);

}  // namespace hrad
