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

void write_steps(CheckpointSink& sink, const CheckpointView& view) {
  sink.write_own(Section::steps, static_cast<int64_t>(view.steps.size()),
                 [&](int64_t first, int64_t, PackedBytes& bytes) {
                   pack_step(view.steps[static_cast<size_t>(first)], bytes);
                 });
}

}  // namespace

void write_checkpoint(Comm& comm, SharedFile& file, const CheckpointView& view, ThreadTeam* team) {
  CheckpointSizes sizes = sizes_of(view);
  add_up(comm, view, sizes);
  // Nothing of a state without links: an empty one stands for it.
  const Scene no_scene;
  const State none(no_scene);
  const State& state = view.state ? *view.state : none;
  CheckpointSink sink(comm, file, team);
  write_small(sink, view, sizes);
  write_scene(sink, view.scene, sizes);
  sink.write(Section::progress, 1,
             [&](int64_t, int64_t, PackedBytes& bytes) { pack_progress(view, sizes, bytes); });
  write_hierarchy(sink, state, sizes);
  if (view.state)
    write_links(sink, view, sizes);
  else
    write_no_links(sink);
  sink.write(Section::light, sizes.nodes(), [&](int64_t first, int64_t end, PackedBytes& bytes) {
    pack_light(state, *view.radiosity, *view.irradiance, first, end, bytes);
  });
  write_steps(sink, view);
  sink.finish();
}

}  // namespace hrad
