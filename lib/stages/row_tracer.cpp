// Cosine-distributed rays, spread evenly over each element and its hemisphere. Floor 7 (stages).
#include "stages/row_tracer.h"

#include <algorithm>
#include <utility>

#include "links/element.h"
#include "stages/element_rays.h"
#include "stages/exchange.h"
#include "stages/leaf_light.h"
#include "stages/task_names.h"

namespace hrad {
namespace {

constexpr int64_t rows_of_a_task = 8;
// Put in place together. Few, so that little stands beside the table.
constexpr int64_t rows_of_a_batch = 8192;

class RowTracer {
 public:
  RowTracer(const State& state, const StageTools& tools, const RowSettings& settings,
            const LightGrid& grid, const BrightSpots& spots)
      : state_(state), tools_(tools), settings_(settings), grid_(grid), spots_(spots) {}

  // The links of one element, sorted by source: those of bright spots, and from so many rays what
  // these leave of its view, of which each ray that met none has an equal part. Returns how many
  // rays were traced.
  int64_t trace(NodeId id, int wanted, Span<const Link> of_spots, std::vector<Link>& links) {
    const Forest& forest = state_.forest;
    const Node& node = forest.nodes[id];
    ElementRays rays(forest, tools_.exposure, tools_.engine, node,
                     mix(key_of(forest, node), settings_.seed, 0x726f77u), wanted);
    hits_.clear();
    met_spots_ = 0;
    int counted = 0;
    for (ElementRays::Ray ray; rays.next(ray); ++counted) {
      met_[together_] = tools_.engine.nearest(ray.origin, ray.direction, 0);
      ray_[together_++] = ray;
      if (together_ == Forest::most_met) take_hits(id);
    }
    take_hits(id);
    double of_view = 0;  // the spots' part
    for (const Link& link : of_spots) of_view += static_cast<double>(link.weight);
    // Chance must not make more of it than there is.
    const double less = of_view > 1 ? 1 / of_view : 1;
    const double rays_of_all = (counted - met_spots_) / (1 - std::min(1.0, of_view));
    const size_t begin = links.size();
    std::sort(hits_.begin(), hits_.end());
    for (size_t k = 0; k < hits_.size() && of_view < 1;) {
      const size_t first = k;
      while (k < hits_.size() && hits_[k] == hits_[first]) ++k;
      links.push_back(
          {hits_[first], static_cast<float>(static_cast<double>(k - first) / rays_of_all)});
    }
    const auto middle = static_cast<std::ptrdiff_t>(links.size());
    for (const Link& link : of_spots)
      links.push_back({link.source, static_cast<float>(less * static_cast<double>(link.weight))});
    std::inplace_merge(links.begin() + static_cast<std::ptrdiff_t>(begin), links.begin() + middle,
                       links.end(),
                       [](const Link& a, const Link& b) { return a.source < b.source; });
    return counted;
  }

 private:
  // The links of the rays that have been traced since the last time.
  void take_hits(NodeId cell) {
    const Forest& forest = state_.forest;
    const Node& node = forest.nodes[cell];
    NodeId source[Forest::most_met];
    forest.leaves_met({met_, together_}, source);
    for (size_t k = 0; k < together_; ++k) {
      if (source[k] < 0 || comes_by_links(node, ray_[k], source[k]) ||
          is_under_a_back(met_[k], source[k]))
        continue;
      if (spots_.sends_to(source[k], cell))
        ++met_spots_;
      else
        hits_.push_back(source[k]);
    }
    together_ = 0;
  }

  // Light from there to this leaf has links of its own.
  bool comes_by_links(const Node& node, const ElementRays::Ray& ray, NodeId source) const {
    const Forest& forest = state_.forest;
    const int32_t emitter = grid_.emitters().of_node(forest.nodes[source].surface);
    if (emitter < 0) return false;
    double u, v;
    root_coordinates(node, ray.x, ray.y, &u, &v);
    const NodeId leaf = forest.leaf_at(node.surface, u, v);
    const bool known =
        settings_.means_only ? forest.nodes[leaf].exposed > 0 : state_.direct.of_leaf[leaf][0] >= 0;
    const OrientedPoint middle = middle_of(forest, leaf);
    return known && grid_.by_links(emitter, middle, grid_.at(middle));
  }

  bool is_under_a_back(const Hit& hit, NodeId source) const {
    return state_.forest.nodes[source].exposed < 1 &&
           tools_.exposure.under_a_back(hit.patch, hit.back,
                                        state_.forest.scene->triangle(hit.patch).at(hit.u, hit.v));
  }

  const State& state_;
  const StageTools& tools_;
  const RowSettings& settings_;
  const LightGrid& grid_;
  const BrightSpots& spots_;
  std::vector<NodeId> hits_;
  int met_spots_ = 0;  // so many rays
  Hit met_[Forest::most_met];
  ElementRays::Ray ray_[Forest::most_met] = {};
  size_t together_ = 0;
};

// rows: of the cells from `first` on.
void put(State& state, const StageTools& tools, const std::vector<Span<const Link>>& rows,
         const std::vector<NodeId>& cells, int64_t first) {
  std::vector<LinkTable::NewRun> runs;
  for (Span<const Link> row : rows) {
    const NodeId cell = cells[static_cast<size_t>(first++)];
    if (tools.exchange.mine(state.forest.nodes[cell].surface)) runs.push_back({cell, row});
  }
  state.links.replace(std::move(runs), &tools.team);
}

}  // namespace

bool trace_rows(State& state, const StageTools& tools, const RowSettings& settings,
                const LightGrid& grid, const BrightSpots& spots, const std::vector<NodeId>& cells,
                const std::vector<int>& rays_of_cell, StageMemory& memory) {
  const Forest& forest = state.forest;
  const int64_t count = static_cast<int64_t>(cells.size());
  const auto is_element = [&](NodeId source) {
    return source >= 0 && static_cast<size_t>(source) < forest.nodes.size() &&
           !Forest::is_cluster(forest.nodes[source]);
  };
  state.journal.next_pass();
  bool going_on = true;
  for (int64_t first = 0; first < count && going_on; first += rows_of_a_batch) {
    const int64_t end = std::min(count, first + rows_of_a_batch);
    const int64_t tasks = (end - first + rows_of_a_task - 1) / rows_of_a_task;
    std::vector<int64_t> rays(static_cast<size_t>(end - first), 0);
    std::vector<uint8_t> is_new(static_cast<size_t>(end - first), 0);
    std::vector<std::vector<Link>> links_of_task(static_cast<size_t>(tasks));
    std::vector<Span<const Link>> rows(static_cast<size_t>(end - first));  // in these
    const auto first_of = [&](int64_t task) {
      return std::min(end, first + task * rows_of_a_task);
    };
    going_on = state.journal.for_each(
        tools.team, tasks,
        [&](int64_t task, int) {
          RowTracer tracer(state, tools, settings, grid, spots);
          std::vector<Link>& links = links_of_task[static_cast<size_t>(task)];
          size_t count_of[rows_of_a_task] = {};
          const int64_t from = first_of(task), to = first_of(task + 1);
          for (int64_t k = from; k < to; ++k) {
            const Node& node = forest.nodes[cells[k]];
            if (!tools.exchange.mine(node.surface) || !(node.exposed > 0)) continue;
            const size_t before = links.size();
            is_new[k - first] = !state.journal.known_run(name_of_element(forest, cells[k]),
                                                         is_element, links, rays[k - first]);
            if (is_new[k - first])
              rays[k - first] = tracer.trace(cells[k], rays_of_cell[k],
                                             spots.links_to(static_cast<size_t>(k)), links);
            count_of[k - from] = links.size() - before;
          }
          links.shrink_to_fit();
          const Link* next = links.data();
          for (int64_t k = from; k < to; next += count_of[k++ - from])
            rows[k - first] = {next, count_of[k - from]};
          const int64_t bytes = static_cast<int64_t>(links.size() * sizeof(Link));
          memory.take(2 * bytes, "rows of rays");  // in two places for a while
        },
        [&](int64_t done) {
          return tools.progress(
              (static_cast<double>(first) + static_cast<double>(done * rows_of_a_task)) /
              static_cast<double>(count + rows_of_a_task));
        },
        [&](LinkStep& step, int64_t task) {
          for (int64_t k = first_of(task); k < first_of(task + 1); ++k)
            if (is_new[k - first])
              step.add_run(name_of_element(forest, cells[k]), rows[k - first], rays[k - first]);
        });
    going_on = tools.exchange.all_go_on(going_on);
    if (!going_on) break;
    for (int64_t r : rays) state.rays += r;
    put(state, tools, rows, cells, first);
    memory.settle();
  }
  if (going_on) tools.exchange.ask_for_sources(state, tools.team);
  return going_on;
}

}  // namespace hrad
