// The points at which direct light is known, numbered in the order in which the leaves name them:
// a matter of the leaves alone, whoever sampled what in which order. Floor 7 (stages).
#pragma once

#include <functional>

#include "stages/state.h"

namespace hrad {

// Keeps of so many points those that the leaves name, once these are settled. links_of: what such a
// point keeps, asked for once, by any thread of the team.
void number_points_by_leaves(CornerLight& direct, size_t points,
                             const std::function<Span<const Link>(int32_t point)>& links_of,
                             ThreadTeam& team);

}  // namespace hrad
