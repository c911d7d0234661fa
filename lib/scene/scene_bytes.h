// A whole scene in bytes and back, for other processes of the same program. Floor 3 (scene).
#pragma once

#include "machine/comm.h"
#include "scene/scene.h"

namespace hrad {

// Collective. Rank 0's, on all.
void broadcast(Comm& comm, Scene& scene);
void broadcast(Comm& comm, Material& material);

}  // namespace hrad
