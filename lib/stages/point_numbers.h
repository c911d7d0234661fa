// The points at which direct light is known, numbered in the order in which the leaves name them:
// a matter of the leaves alone, whoever sampled what in which order. Floor 7 (stages).
#pragma once

#include <functional>

#include "stages/state.h"

namespace hrad {

// Keeps the points that these leaves name, with these of their links. Other leaves have none then.
// With a team keep_link is called on its threads.
void number_points_by_leaves(CornerLight& direct, const std::function<bool(NodeId leaf)>& keep_leaf,
                             const std::function<bool(int32_t point, const Link&)>& keep_link,
                             ThreadTeam* team = nullptr);

}  // namespace hrad
