// What only the ray engine can tell about a scene before it is solved: windings that are probably
// wrong, and patches that are too small for rays. Floor 4 (visibility).
#pragma once

#include <cstdint>

#include "scene/scene.h"
#include "visibility/exposure.h"
#include "visibility/visibility.h"

namespace hrad {

struct Inspection {
  // Share of rays, half of them from emitters, half from all surfaces by area, that met a black
  // back.
  double back_share = 0;
  // Mean length of the rays from all surfaces that met one, half the scene's diagonal where none
  // did: the size of rooms.
  double mean_distance = 0;
  // Patches little longer than the length by which ray ends are moved off their surfaces: what they
  // shade or seal can't be told.
  int64_t unresolved = 0, first_unresolved = 0;
  double smallest = 0;          // the length below which that is so
  double seconds_of_a_ray = 0;  // on one thread, to guess how long others take
};

// The same for any number of threads and for every engine but for rounding.
Inspection inspect(const Scene& scene, const VisibilityEngine& engine, const Exposure& exposure);

}  // namespace hrad
