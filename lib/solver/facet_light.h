// Light on the facets of curved surfaces. Each has rays of its own, but so few that its light is
// mostly noise where it is much smaller than cells elsewhere; what such facets share is not.
// Floor 8 (solver).
#pragma once

#include <vector>

#include "hierarchy/forest.h"

namespace hrad {

// Evens out what arrives at the cells, `bands` values each, over facets of one surface, curved or
// plane, so far that about the area `reach` has one light. Their mean stays what it is.
void even_out_facets(const Forest& forest, int bands, const std::vector<NodeId>& cells,
                     double reach, std::vector<float>& light);

}  // namespace hrad
