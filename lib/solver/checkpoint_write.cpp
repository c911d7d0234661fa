// Writing a checkpoint, section by section. Floor 8 (solver).
#include "solver/checkpoint.h"
#include "solver/checkpoint_format.h"
#include "solver/checkpoint_light.h"
#include "solver/checkpoint_runs.h"
#include "solver/checkpoint_scene.h"
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

void write_links(CheckpointSink& sink, const State& state, const CheckpointSizes& sizes) {
  const CornerLight& direct = state.direct;
  const auto runs = [&](Section section, int64_t receivers, const RunOf& run_of) {
    sink.write(section, receivers, [&](int64_t first, int64_t end, PackedBytes& bytes) {
      pack_runs(first, end, run_of, bytes);
    });
  };
  runs(Section::links, sizes.nodes(),
       [&](int64_t k) { return state.links[static_cast<size_t>(k)].links(); });
  sink.write(Section::cells, sizes.cells, [&](int64_t first, int64_t end, PackedBytes& bytes) {
    pack_cells(state.cells, first, end, bytes);
  });
  runs(Section::mean_light, sizes.receivers_of_means,
       [&](int64_t k) { return direct.mean[static_cast<size_t>(k)].links(); });
  sink.write(Section::points, sizes.leaves_of_points,
             [&](int64_t first, int64_t end, PackedBytes& bytes) {
               pack_points(state, first, end, bytes);
             });
  runs(Section::point_links, sizes.points, [&](int64_t k) {
    const uint32_t first = direct.first[static_cast<size_t>(k)];
    return Span<const Link>(direct.links.data() + first,
                            direct.first[static_cast<size_t>(k) + 1] - first);
  });
  sink.write(Section::own_points, sizes.own_points,
             [&](int64_t first, int64_t end, PackedBytes& bytes) {
               pack_own_points(direct, first, end, bytes);
             });
}

}  // namespace

void write_checkpoint(WholeFile& file, const CheckpointView& view, ThreadTeam* team) {
  const CheckpointSizes sizes = sizes_of(view);
  // Nothing of a state without links: an empty one stands for it.
  const Scene no_scene;
  const State none(no_scene);
  const State& state = view.state ? *view.state : none;
  CheckpointSink sink(file, team);
  write_small(sink, view, sizes);
  write_scene(sink, view.scene, sizes);
  sink.write(Section::progress, 1,
             [&](int64_t, int64_t, PackedBytes& bytes) { pack_progress(view, bytes); });
  write_hierarchy(sink, state, sizes);
  write_links(sink, state, sizes);
  sink.write(Section::light, sizes.nodes(), [&](int64_t first, int64_t end, PackedBytes& bytes) {
    pack_light(state, first, end, bytes);
  });
  sink.write(Section::steps, sizes.steps, [&](int64_t first, int64_t, PackedBytes& bytes) {
    pack_step(view.journal->steps()[static_cast<size_t>(first)], bytes);
  });
  sink.finish();
}

}  // namespace hrad
