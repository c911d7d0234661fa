// The points at which direct light is known, numbered in the order in which the leaves name them:
// a matter of the leaves alone, whoever sampled what in which order. Floor 7 (stages).
#pragma once

#include <functional>
#include <vector>

#include "stages/state.h"

namespace hrad {

// Keeps the points that these leaves name, with these of their links. Other leaves have none then.
void number_points_by_leaves(CornerLight& direct, const std::function<bool(NodeId leaf)>& keep_leaf,
                             const std::function<bool(int32_t point, const Link&)>& keep_link);

// The same of so many points whose links are elsewhere: take_links appends those that a point
// keeps, on the threads of a team if there is one.
void number_points_by_leaves(
    CornerLight& direct, size_t points, const std::function<bool(NodeId leaf)>& keep_leaf,
    const std::function<void(int32_t point, std::vector<Link>& links)>& take_links,
    ThreadTeam* team);

}  // namespace hrad
