// Names of elements and of points on them as tasks of a pass: neighbours have neighbouring names,
// so that these take little space in a file. Floor 7 (stages).
#pragma once

#include "hierarchy/forest.h"
#include "hierarchy/lattice.h"

namespace hrad {

// which: 0 to 3, tells apart what belongs to one element.
uint64_t name_of_element(const Forest& forest, NodeId element, int which = 0);
uint64_t name_of_corner(int32_t surface, LatticePoint point);

}  // namespace hrad
