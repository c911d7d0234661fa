// The generators of the built-in scenes; builtin.cpp names them. All are made of integers times a
// step, square roots at most, so that the bits are the same on every machine. z is up, metres.
// Floor 3 (scene).
#pragma once

#include "scene/scene.h"

namespace hrad {

// Paper, section 4: many identical furnished rooms joined by door openings; 2,880*size patches.
// size is 1, 10 or 100.
void generate_building(Scene& scene, int size);

// Paper, section 4: one clear room with rows of desks; 9,253*size patches. size is 1, 10 or 100.
void generate_classroom(Scene& scene, int size);

// The Cornell box, open at its front; the light hangs 1 cm below the ceiling. size is unused here
// and below: these scenes have one size.
void generate_cornell(Scene& scene, int size);

// A small closed room: table, four chairs, shelf with books, sideboard, ceiling lamp.
void generate_furnished_room(Scene& scene, int size);

// Closed surfaces with E = 1 and rho = 0.5 everywhere: exposed points have B = 2, sealed ones 1.
void generate_furnace(Scene& scene, int size);
void generate_furnace_sphere(Scene& scene, int size);
void generate_furnace_boxes(Scene& scene, int size);

// A black cube of side 1 with E = 1 in the middle of a black cube of side 3: the mean irradiance of
// the outer one is exactly 1/9.
void generate_box_in_box(Scene& scene, int size);

// Two black unit squares at distance 1; the lower one has E = 1.
void generate_parallel_plates(Scene& scene, int size);

}  // namespace hrad
