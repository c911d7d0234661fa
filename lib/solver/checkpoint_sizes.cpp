// Small sections, number by number. Floor 8 (solver).
#include "solver/checkpoint_sizes.h"

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "base/version.h"
#include "solver/schedule.h"

namespace hrad {
namespace {

constexpr int64_t most_nodes = std::numeric_limits<int32_t>::max();
constexpr int64_t most_links = int64_t{1} << 40;
constexpr int64_t most = int64_t{1} << 53;
constexpr double largest = std::numeric_limits<double>::max();
constexpr int most_rounds = 64;

// The numbers of the section in their order.
constexpr struct {
  const char* what;
  int64_t CheckpointSizes::*value;
  int64_t lowest, highest;
} rows[] = {
    {"the number of bands", &CheckpointSizes::bands, 1, 16},
    {"the number of vertices", &CheckpointSizes::vertices, 0, most_nodes},
    {"the number of materials", &CheckpointSizes::materials, 0, most_nodes},
    {"the number of patches", &CheckpointSizes::patches, 0, most_nodes},
    {"the number of surfaces", &CheckpointSizes::surfaces, 0, most_nodes},
    {"the number of clusters", &CheckpointSizes::clusters, 0, most_nodes},
    {"the number of families", &CheckpointSizes::families, 0, most_nodes / 4},
    {"the number of links", &CheckpointSizes::links, 0, most_links},
    {"the number of cells", &CheckpointSizes::cells, 0, most_nodes},
    {"the number of receivers of means", &CheckpointSizes::receivers_of_means, 0, most_nodes},
    {"the number of links of means", &CheckpointSizes::mean_links, 0, most_links},
    {"the number of leaves with points", &CheckpointSizes::leaves_of_points, 0, most_nodes},
    {"the number of points", &CheckpointSizes::points, 0, most_nodes},
    {"the number of links of points", &CheckpointSizes::point_links, 0,
     std::numeric_limits<uint32_t>::max()},
    {"the number of own points", &CheckpointSizes::own_points, 0, most_nodes},
    {"the number of steps", &CheckpointSizes::steps, 0, most_nodes},
};

}  // namespace

CheckpointSizes sizes_of(const CheckpointView& view) {
  const Scene& scene = view.scene;
  const State* state = view.state;
  CheckpointSizes s;
  s.bands = scene.bands;
  s.vertices = static_cast<int64_t>(scene.vertices.size());
  s.materials = static_cast<int64_t>(scene.materials.size());
  s.patches = scene.patch_count();
  s.steps = static_cast<int64_t>(view.steps.size());
  if (!state) return s;
  const auto nodes = state->nodes_in_order >= 0 ? state->nodes_in_order
                                                : static_cast<int64_t>(state->forest.nodes.size());
  s.surfaces = state->forest.surface_count();
  s.clusters = static_cast<int64_t>(state->forest.clusters.clusters.size());
  s.families = (nodes - s.surfaces - s.clusters) / 4;
  s.links = state->links.link_count();
  s.cells = static_cast<int64_t>(state->cells.size());
  s.receivers_of_means = static_cast<int64_t>(state->direct.mean.size());
  s.mean_links = state->direct.mean.link_count();
  s.leaves_of_points = static_cast<int64_t>(state->direct.of_leaf.size());
  s.points = static_cast<int64_t>(state->direct.point_count());
  s.point_links = static_cast<int64_t>(state->direct.links.size());
  s.own_points = static_cast<int64_t>(3 * state->direct.of_leaf.own_count());
  return s;
}

void pack_sizes(const CheckpointSizes& sizes, PackedBytes& bytes) {
  for (const auto& row : rows) bytes.varint(static_cast<uint64_t>(sizes.*row.value));
}

CheckpointSizes unpack_sizes(PackedReader& bytes, const CheckpointSource& source) {
  CheckpointSizes s;
  for (const auto& row : rows) s.*row.value = bytes.count(row.what, row.lowest, row.highest);
  // In the file, expanded, every item takes so many bytes at the least.
  const struct {
    Section section;
    int64_t items;
    uint64_t least_bytes;
  } least[] = {
      {Section::materials, s.materials, 2},
      {Section::vertices, s.vertices, 24},
      {Section::patches, s.patches, 7},
      {Section::tree, s.families, 1},
      {Section::nodes, s.nodes(), 5},
      {Section::clusters, s.clusters, 10},
      {Section::links, s.links, 1},
      {Section::links, s.nodes(), 1},
      {Section::cells, s.cells, 1},
      {Section::mean_light, s.mean_links, 1},
      {Section::point_links, s.points, 1},
      {Section::point_links, s.point_links, 1},
      {Section::own_points, s.own_points, 9},
      {Section::steps, s.steps, 2},
      {Section::light, s.nodes(), 8 * static_cast<uint64_t>(s.bands)},
  };
  for (const auto& row : least)
    if (static_cast<uint64_t>(row.items) > source.entry(row.section).raw / row.least_bytes)
      fail_format(bytes.place(), "%lld items can't be in the %llu bytes of section '%s'",
                  static_cast<long long>(row.items),
                  static_cast<unsigned long long>(source.entry(row.section).raw),
                  section_name(row.section));
  const int64_t nodes = s.nodes();
  if (nodes > most_nodes || s.surfaces > 2 * s.patches ||
      (s.receivers_of_means != 0 && s.receivers_of_means != nodes) ||
      (s.leaves_of_points != 0 && s.leaves_of_points != nodes) ||
      (s.leaves_of_points != 0 && s.receivers_of_means == 0) ||
      (s.receivers_of_means != 0 && s.cells == 0) ||
      (s.leaves_of_points == 0 && (s.points > 0 || s.own_points > 0)) ||
      (s.clusters > 0 && s.clusters >= s.surfaces))
    fail_format(bytes.place(),
                "%lld patches, %lld surfaces, %lld clusters, %lld elements and "
                "what is known of them don't fit together",
                static_cast<long long>(s.patches), static_cast<long long>(s.surfaces),
                static_cast<long long>(s.clusters), static_cast<long long>(4 * s.families));
  return s;
}

int64_t bytes_of(const CheckpointSizes& s) {
  const int64_t of_patch = 3 * 4 + 4 + 8 + 1 + 16 * s.bands;
  const int64_t of_node =
      NodeArray::most_bytes_of_a_node + LinkTable::most_bytes_of_a_receiver + 16 * s.bands;
  return 24 * s.vertices + of_patch * s.patches + of_node * s.nodes() +
         static_cast<int64_t>(sizeof(Cluster)) * s.clusters +
         LinkTable::most_bytes_of_a_receiver * s.receivers_of_means + 12 * s.leaves_of_points +
         4 * (s.cells + s.points) + 12 * s.own_points +
         static_cast<int64_t>(sizeof(Link)) * (s.links + s.mean_links + s.point_links);
}

std::string origin_text(const Params& params) {
  std::string text = std::string("libhrad ") + version_text() + ", rays by ";
  if (params.visibility != "embree") return text + params.visibility;
#ifdef HRAD_WITH_EMBREE
  return text + format("embree %d", HRAD_WITH_EMBREE);
#else
  return text + params.visibility;
#endif
}

void pack_params(const Params& params, PackedBytes& bytes) {
  uint64_t count = 0;
  for (const ParamRow& row : param_table()) count += row.is_result;
  bytes.varint(count);
  for (const ParamRow& row : param_table())
    if (row.is_result) {
      bytes.text(row.name);
      bytes.text(param_text(params, row));
    }
}

void unpack_params(PackedReader& bytes, Params& params) {
  const int64_t count = bytes.count("the number of parameters", 0, 1000);
  std::string before;
  std::vector<std::string> names;
  for (int64_t k = 0; k < count; ++k) {
    const std::string name = bytes.text(longest_param_text), value = bytes.text(longest_param_text);
    if (std::find(names.begin(), names.end(), name) != names.end())
      fail_format(bytes.place(), "parameter '%s' is there twice", name.c_str());
    names.push_back(name);
    try {
      const ParamRow& row = find_param(name);
      if (!row.is_result)
        fail(Status::argument, "parameter '%s' is none that decides a result", name.c_str());
      set_param(params, row, value);
    } catch (const Error& error) {
      fail_format(bytes.place(), "%s", error.what());
    }
  }
}

void pack_progress(const CheckpointView& view, const CheckpointSizes& sizes, PackedBytes& bytes) {
  const SolveProgress& p = view.progress;
  for (bool flag : {view.begun, p.linked, p.sweeping, p.from_emission, p.converged, p.finished,
                    p.measuring_due, view.stats.converged})
    bytes.byte(flag);
  for (int64_t count : {static_cast<int64_t>(p.rounds_done), static_cast<int64_t>(p.tightened),
                        static_cast<int64_t>(p.sweeping_round), p.earlier_sweeps, view.stats.rounds,
                        view.stats.iterations, view.rays, view.pairs, view.inspection.unresolved,
                        view.inspection.first_unresolved})
    bytes.varint(static_cast<uint64_t>(count));
  bytes.u64(p.light_hash);
  bytes.u64(p.mesh_hash);
  bytes.u64(sizes.steps > 0 ? view.key_of_steps : 0);
  for (double number :
       {p.scale, p.accuracy_reached, p.convergence.tolerance(), view.stats.error_estimate,
        view.stats.error_standard_error, view.balance.back_share, view.inspection.back_share,
        view.inspection.mean_distance, view.inspection.smallest})
    bytes.number(number);
  for (const auto* numbers :
       {&p.convergence.last(), &p.convergence.change(), &view.balance.emitted,
        &view.balance.absorbed, &view.balance.absorbed_back, &view.balance.escaped}) {
    bytes.varint(numbers->size());
    for (double number : *numbers) bytes.number(number);
  }
}

void unpack_progress(PackedReader& bytes, CheckpointContent& content) {
  SolveProgress& p = content.progress;
  Stats& stats = content.stats;
  Inspection& inspection = content.inspection;
  for (bool* flag : {&content.begun, &p.linked, &p.sweeping, &p.from_emission, &p.converged,
                     &p.finished, &p.measuring_due, &stats.converged})
    *flag = bytes.flag("a flag of the progress");
  const auto rounds = [&](int highest) {
    return static_cast<int>(bytes.count("a number of rounds", 0, highest));
  };
  p.rounds_done = rounds(most_rounds);
  p.tightened = rounds(most_tightenings);
  p.sweeping_round = rounds(most_rounds);
  for (int64_t* count : {&p.earlier_sweeps, &stats.rounds, &stats.iterations, &content.rays,
                         &content.pairs, &inspection.unresolved, &inspection.first_unresolved})
    *count = bytes.count("a count of the progress", 0, most);
  if (p.earlier_sweeps > stats.iterations || (!p.linked && (p.sweeping || p.finished)) ||
      (p.linked && !content.begun))
    fail_format(bytes.place(),
                "%lld of %lld sweeps were for other lights: the steps of the solve "
                "don't fit together",
                static_cast<long long>(p.earlier_sweeps), static_cast<long long>(stats.iterations));
  p.light_hash = bytes.u64();
  p.mesh_hash = bytes.u64();
  content.key_of_steps = bytes.u64();
  p.scale = bytes.finite("the scale of thresholds", least_scale, 1);
  p.accuracy_reached = bytes.finite("the accuracy reached", 0, 1);
  const double tolerance = bytes.finite("the tolerance of sweeps", 0, 1);
  stats.error_estimate = bytes.finite("the estimate of the error", -1, largest);
  stats.error_standard_error = bytes.finite("the standard error", 0, largest);
  content.balance.back_share = bytes.finite("the share of backs", 0, 1);
  inspection.back_share = bytes.finite("the share of backs", 0, 1);
  inspection.mean_distance = bytes.finite("the mean distance", 0, largest);
  inspection.smallest = bytes.finite("the smallest length", 0, largest);
  std::vector<double> last, change;
  for (auto* numbers : {&last, &change, &content.balance.emitted, &content.balance.absorbed,
                        &content.balance.absorbed_back, &content.balance.escaped}) {
    const int64_t count = bytes.count("a number of bands", 0, content.params.bands);
    if (count != 0 && count != content.params.bands)
      fail_format(bytes.place(), "%lld numbers stand for %lld bands", static_cast<long long>(count),
                  static_cast<long long>(content.params.bands));
    for (int64_t k = 0; k < count; ++k)
      numbers->push_back(bytes.finite("a power", -largest, largest));
  }
  if (last.empty() && !change.empty())
    fail_format(bytes.place(), "totals of light change that aren't there");
  p.convergence = Convergence(tolerance, std::move(last), std::move(change));
}

}  // namespace hrad
