// The small sections of a checkpoint: what wrote it, parameters, sizes of the others, progress and
// measurements. Floor 8 (solver).
#pragma once

#include "solver/checkpoint.h"
#include "solver/checkpoint_format.h"

namespace hrad {

struct CheckpointSizes {
  int64_t bands = 0, vertices = 0, materials = 0, patches = 0;
  // Of the solution, all 0 where nothing is linked:
  int64_t surfaces = 0, clusters = 0, families = 0, links = 0, cells = 0;
  int64_t receivers_of_means = 0, mean_links = 0;  // nodes, or 0 where there is no direct light
  int64_t leaves_of_points = 0;                    // nodes, or 0 where light is known at no points
  int64_t points = 0, point_links = 0, own_points = 0;
  int64_t steps = 0;  // of linking or refinement that is under way
  int64_t nodes() const { return surfaces + clusters + 4 * families; }
};

// Of what this process has.
CheckpointSizes sizes_of(const CheckpointView& view);
void pack_sizes(const CheckpointSizes& sizes, PackedBytes& bytes);
// FORMAT when a section is too short for what it is to hold.
CheckpointSizes unpack_sizes(PackedReader& bytes, const CheckpointSource& source);
// Of the arrays that will hold it all.
int64_t bytes_of(const CheckpointSizes& sizes);

std::string origin_text(const Params& params);
void pack_params(const Params& params, PackedBytes& bytes);
void unpack_params(PackedReader& bytes, Params& params);

void pack_progress(const CheckpointView& view, const CheckpointSizes& sizes, PackedBytes& bytes);
void unpack_progress(PackedReader& bytes, CheckpointContent& content);

void pack_step(const LinkStep& step, PackedBytes& bytes);
LinkStep unpack_step(PackedReader& bytes);

}  // namespace hrad
