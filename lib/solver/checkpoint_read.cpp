// Reading a checkpoint, section by section, each checked before it is used. Floor 8 (solver).
#include <utility>

#include "base/error.h"
#include "solver/checkpoint.h"
#include "solver/checkpoint_format.h"
#include "solver/checkpoint_light.h"
#include "solver/checkpoint_runs.h"
#include "solver/checkpoint_scene.h"
#include "solver/checkpoint_sizes.h"
#include "solver/checkpoint_tree.h"

namespace hrad {
namespace {

class Reading {
 public:
  Reading(const CheckpointSource& source, MemoryBudget& budget, CheckpointContent& content)
      : source_(source), budget_(budget), content_(content) {}

  void run() {
    one(Section::origin,
        [&](PackedReader& bytes) { content_.origin = bytes.text(longest_origin); });
    one(Section::parameters, [&](PackedReader& bytes) { unpack_params(bytes, content_.params); });
    one(Section::sizes, [&](PackedReader& bytes) { sizes_ = unpack_sizes(bytes, source_); });
    if (sizes_.bands != content_.params.bands)
      fail_format(source_.place(Section::sizes),
                  "%lld bands are stored and parameter 'bands' is "
                  "%lld",
                  static_cast<long long>(sizes_.bands),
                  static_cast<long long>(content_.params.bands));
    budget_.take(bytes_of(sizes_), "what the checkpoint holds");
    read_scene();
    one(Section::progress, [&](PackedReader& bytes) { unpack_progress(bytes, content_); });
    if (content_.progress.linked) {
      // Of a scene in which nothing exchanges light it is empty.
      content_.state = std::make_unique<State>(content_.scene);
      if (content_.state->forest.surface_count() != sizes_.surfaces)
        fail_format(source_.place(Section::sizes), "the scene has %lld surfaces, not %lld",
                    static_cast<long long>(content_.state->forest.surface_count()),
                    static_cast<long long>(sizes_.surfaces));
    } else if (sizes_.surfaces > 0) {
      fail_format(source_.place(Section::progress), "it doesn't tell of links that are there");
    }
    const Scene no_scene;
    State none(no_scene);
    State& state = content_.state ? *content_.state : none;
    read_hierarchy(state);
    read_links(state);
    read_direct_light(state);
    LightReader light(state);
    source_.read(
        Section::light, sizes_.nodes(),
        [&](int64_t first, int64_t end, PackedReader& bytes) { light.unpack(bytes, first, end); });
    light.finish(source_.place(Section::light));
    source_.read(Section::steps, sizes_.steps, [&](int64_t, int64_t, PackedReader& bytes) {
      if (source_.version() == 1)
        bytes.raw(bytes.left());  // linking does them again
      else
        content_.steps.push_back(unpack_step(bytes));
    });
  }

 private:
  static constexpr size_t longest_origin = 4096;

  template <class Unpack>
  void one(Section section, const Unpack& unpack) {
    source_.read(section, 1, [&](int64_t, int64_t, PackedReader& bytes) { unpack(bytes); });
  }

  void read_scene() {
    Scene& scene = content_.scene;
    scene.bands = static_cast<int>(sizes_.bands);
    one(Section::materials,
        [&](PackedReader& bytes) { unpack_materials(bytes, sizes_.materials, scene); });
    scene.vertices.reserve(static_cast<size_t>(sizes_.vertices));
    source_.read(Section::vertices, sizes_.vertices,
                 [&](int64_t first, int64_t end, PackedReader& bytes) {
                   unpack_vertices(bytes, first, end, scene);
                 });
    source_.read(Section::patches, sizes_.patches,
                 [&](int64_t first, int64_t end, PackedReader& bytes) {
                   unpack_patches(bytes, first, end, scene);
                 });
  }

  void read_hierarchy(State& state) {
    Forest& forest = state.forest;
    forest.nodes.add_clusters(static_cast<size_t>(sizes_.clusters));
    forest.nodes.reserve(static_cast<size_t>(sizes_.nodes()));
    forest.clusters.clusters.resize(static_cast<size_t>(sizes_.clusters));
    source_.read(Section::tree, sizes_.families,
                 [&](int64_t first, int64_t end, PackedReader& bytes) {
                   unpack_families(bytes, first, end, forest);
                 });
    source_.read(Section::nodes, sizes_.nodes(),
                 [&](int64_t first, int64_t end, PackedReader& bytes) {
                   unpack_nodes(bytes, first, end, forest);
                 });
    source_.read(Section::clusters, sizes_.clusters > 0 ? 1 : 0,
                 [&](int64_t, int64_t, PackedReader& bytes) {
                   unpack_clusters(bytes, sizes_.clusters, forest);
                 });
  }

  // Runs of so many receivers, whose sources are below a node.
  void read_runs(Section section, int64_t receivers, int64_t links, int64_t sources,
                 const std::function<void(Span<const Link>)>& take) {
    int64_t left = links;
    source_.read(section, receivers, [&](int64_t first, int64_t end, PackedReader& bytes) {
      unpack_runs(first, end, static_cast<NodeId>(sources), left, bytes, take);
    });
    if (left != 0)
      fail_format(source_.place(section), "%lld of %lld links are not there",
                  static_cast<long long>(left), static_cast<long long>(links));
  }

  void read_links(State& state) {
    read_runs(Section::links, sizes_.nodes(), sizes_.links, sizes_.nodes(),
              [&](Span<const Link> run) { state.links.append(run); });
    state.links.shrink_to_fit();
    source_.read(
        Section::cells, sizes_.cells, [&](int64_t first, int64_t end, PackedReader& bytes) {
          unpack_cells(bytes, first, end, static_cast<NodeId>(sizes_.nodes()), state.cells);
        });
    if (sizes_.cells > 0) check_cover(state.forest, state.cells, source_.place(Section::cells));
  }

  void read_direct_light(State& state) {
    CornerLight& direct = state.direct;
    const int64_t emitters = sizes_.surfaces + sizes_.clusters;
    read_runs(Section::mean_light, sizes_.receivers_of_means, sizes_.mean_links, emitters,
              [&](Span<const Link> run) { direct.mean.append(run); });
    direct.mean.shrink_to_fit();
    // The points are numbered by what comes before their links in the file.
    if (sizes_.receivers_of_means > 0)
      direct.first.assign(static_cast<size_t>(sizes_.points) + 1, 0);
    direct.of_leaf.reserve(static_cast<size_t>(sizes_.leaves_of_points));
    source_.read(Section::points, sizes_.leaves_of_points,
                 [&](int64_t first, int64_t end, PackedReader& bytes) {
                   unpack_points(bytes, first, end, state);
                 });
    direct.of_leaf.shrink_to_fit();
    if (sizes_.own_points != static_cast<int64_t>(3 * direct.of_leaf.own_count()))
      fail_format(source_.place(Section::points),
                  "%lld points are known as those of one leaf alone, and named are %lld",
                  static_cast<long long>(sizes_.own_points),
                  static_cast<long long>(3 * direct.of_leaf.own_count()));
    size_t point = 0;
    direct.links.reserve(static_cast<size_t>(sizes_.point_links));
    read_runs(Section::point_links, sizes_.points, sizes_.point_links, emitters,
              [&](Span<const Link> run) {
                direct.links.insert(direct.links.end(), run.begin(), run.end());
                direct.first[++point] = static_cast<uint32_t>(direct.links.size());
              });
    source_.read(Section::own_points, sizes_.own_points,
                 [&](int64_t first, int64_t end, PackedReader& bytes) {
                   unpack_own_points(bytes, first, end, direct);
                 });
    check_points(state, source_.place(Section::points));
  }

  const CheckpointSource& source_;
  MemoryBudget& budget_;
  CheckpointContent& content_;
  CheckpointSizes sizes_;
};

}  // namespace

std::unique_ptr<CheckpointContent> read_checkpoint(const std::string& bytes, int64_t limit) {
  MemoryBudget budget;
  budget.set_limit(limit);
  const CheckpointSource source(bytes, budget);
  auto content = std::make_unique<CheckpointContent>();
  Reading(source, budget, *content).run();
  for (size_t k = 0; k < section_count; ++k) {
    const auto section = static_cast<Section>(k);
    content->section_bytes.emplace_back(section_name(section),
                                        static_cast<int64_t>(source.entry(section).stored));
  }
  return content;
}

std::unique_ptr<CheckpointContent> read_checkpoint_file(const std::string& path, int64_t limit) {
  std::string bytes;
  if (!read_file(path, bytes)) fail(Status::file, "%s: there is no such file", path.c_str());
  return read_checkpoint_bytes(path, bytes, limit);
}

std::unique_ptr<CheckpointContent> read_checkpoint_bytes(const std::string& path,
                                                         const std::string& bytes, int64_t limit) {
  try {
    return read_checkpoint(bytes, limit);
  } catch (const Error& error) {
    throw Error(error.status(), path + ": " + error.what());
  }
}

}  // namespace hrad
