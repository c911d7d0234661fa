// Writing a checkpoint, section by section. Floor 8 (solver).
#include "solver/checkpoint.h"
#include "solver/checkpoint_light.h"
#include "solver/checkpoint_links.h"
#include "solver/checkpoint_scene.h"
#include "solver/checkpoint_sink.h"
#include "solver/checkpoint_sizes.h"
#include "solver/checkpoint_tree.h"

namespace hrad {
namespace {

void write_small(CheckpointSink& sink, const CheckpointView& view, const CheckpointSizes& sizes) {
  const auto one = [&sink](Section section, const auto& pack) {
    sink.write(section, 1, [&](int64_t, int64_t, PackedBytes& bytes) { pack(bytes); });
  };
  one(Section::origin, [&](PackedBytes& bytes) { bytes.text(origin_text(view.params)); });
  one(Section::parameters, [&](PackedBytes& bytes) { pack_params(view.params, bytes); });
  one(Section::sizes, [&](PackedBytes& bytes) { pack_sizes(sizes, bytes); });
}

void write_scene(CheckpointSink& sink, const Scene& scene, const CheckpointSizes& sizes) {
  sink.write(Section::materials, 1,
             [&](int64_t, int64_t, PackedBytes& bytes) { pack_materials(scene, bytes); });
  sink.write(Section::vertices, sizes.vertices,
             [&](int64_t first, int64_t end, PackedBytes& bytes) {
               pack_vertices(scene, first, end, bytes);
             });
  sink.write(Section::patches, sizes.patches, [&](int64_t first, int64_t end, PackedBytes& bytes) {
    pack_patches(scene, first, end, bytes);
  });
}

void write_hierarchy(CheckpointSink& sink, const State& state, const CheckpointSizes& sizes) {
  const Forest& forest = state.forest;
  sink.write(Section::tree, sizes.families, [&](int64_t first, int64_t end, PackedBytes& bytes) {
    pack_families(forest, first, end, bytes);
  });
  sink.write(Section::nodes, sizes.nodes(), [&](int64_t first, int64_t end, PackedBytes& bytes) {
    pack_nodes(forest, first, end, bytes);
  });
  sink.write(Section::clusters, sizes.clusters > 0 ? 1 : 0,
             [&](int64_t, int64_t, PackedBytes& bytes) { pack_clusters(forest, bytes); });
}

// What a stage that is under way has done so far: each process its own steps, and the first one
// those that all have.
Span<const LinkStep> own_steps(const CheckpointView& view, int rank) {
  if (!view.journal) return {};
  const std::vector<LinkStep>& steps = view.journal->steps();
  const size_t first = rank == 0 ? 0 : view.journal->steps_of_all();
  return {steps.data() + first, steps.size() - first};
}

}  // namespace

void write_checkpoint(Comm& comm, SharedFile& file, const CheckpointView& view, ThreadTeam* team) {
  CheckpointSizes sizes = sizes_of(view);
  add_up_links(view, sizes);
  const Span<const LinkStep> steps = own_steps(view, comm.rank());
  uint64_t all_steps = steps.size();
  comm.add_up({&all_steps, 1});
  sizes.steps = static_cast<int64_t>(all_steps);
  // Nothing of a state without links: an empty one stands for it.
  const Scene no_scene;
  const State none(no_scene);
  const State& state = view.state ? *view.state : none;
  CheckpointSink sink(comm, file, team);
  write_small(sink, view, sizes);
  write_scene(sink, view.scene, sizes);
  sink.write(Section::progress, 1,
             [&](int64_t, int64_t, PackedBytes& bytes) { pack_progress(view, bytes); });
  write_hierarchy(sink, state, sizes);
  if (view.state)
    write_links(sink, view, sizes);
  else
    write_no_links(sink);
  sink.write(Section::light, sizes.nodes(), [&](int64_t first, int64_t end, PackedBytes& bytes) {
    pack_light(state, first, end, bytes);
  });
  sink.write_own(Section::steps, static_cast<int64_t>(steps.size()),
                 [&](int64_t first, int64_t, PackedBytes& bytes) {
                   pack_step(steps[static_cast<size_t>(first)], bytes);
                 });
  sink.finish();
}

}  // namespace hrad
