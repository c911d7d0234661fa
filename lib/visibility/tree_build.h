// Building the tree of the builtin engine. Floor 4 (visibility).
#pragma once

#include "base/vec3.h"
#include "machine/thread_team.h"
#include "scene/scene.h"
#include "visibility/tree.h"

namespace hrad {

// A tree over all patches of the scene but the dropped ones, relative to the center. padding: what
// the boxes are larger on every side. The same tree whatever the size of the team.
Tree build_tree(const Scene& scene, Vec3 center, float padding, ThreadTeam& team);

// Hash of nodes and leaves, for comparing trees.
uint64_t hash_of(const Tree& tree);

}  // namespace hrad
