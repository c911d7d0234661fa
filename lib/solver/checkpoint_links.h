// What of a checkpoint every owner has its own part of: links, and points of direct light.
// Floor 8 (solver).
#pragma once

#include "solver/checkpoint.h"
#include "solver/checkpoint_sink.h"
#include "solver/checkpoint_sizes.h"

namespace hrad {

// Collective, as all that follows. From what this process has to what all have.
void add_up(Comm& comm, const CheckpointView& view, CheckpointSizes& sizes);

// The sections from `links` on up to `own_points`.
void write_links(CheckpointSink& sink, const CheckpointView& view, const CheckpointSizes& sizes);
// The same of no state.
void write_no_links(CheckpointSink& sink);

}  // namespace hrad
