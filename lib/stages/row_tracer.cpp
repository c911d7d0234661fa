// Cosine-distributed rays, spread evenly over each element and its hemisphere. Floor 7 (stages).
#include "stages/row_tracer.h"

#include <algorithm>
#include <utility>

#include "links/element.h"
#include "machine/pieces.h"
#include "stages/element_rays.h"
#include "stages/exchange.h"
#include "stages/leaf_light.h"
#include "stages/task_names.h"

namespace hrad {
namespace {

constexpr int64_t rays_of_a_task = 256;
// Put in place together. Few, so that little stands beside the table.
constexpr size_t rows_of_a_batch = 8192;

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

// The cells that this process gives rows, in tasks of about as many rays, and these in batches.
class OwnRows {
 public:
  OwnRows(const State& state, const StageTools& tools, const std::vector<NodeId>& cells,
          const std::vector<int>& rays_of_cell)
      : cells_(gathered<size_t>(tools.team, cells.size(), [&](size_t k, std::vector<size_t>& some) {
          const Node& node = state.forest.nodes[cells[k]];
          if (tools.exchange.mine(node.surface) && node.exposed > 0) some.push_back(k);
        })) {
    int64_t rays = rays_of_a_task;
    size_t in_batch = rows_of_a_batch;
    for (size_t row = 0; row < cells_.size(); ++row) {
      if (rays >= rays_of_a_task) {
        if (in_batch >= rows_of_a_batch) {
          batches_.push_back(first_.size());
          in_batch = 0;
        }
        first_.push_back(row);
        rays = 0;
      }
      rays += rays_of_cell[cells_[row]];
      ++in_batch;
    }
    batches_.push_back(first_.size());
    first_.push_back(cells_.size());
  }
  size_t cell(size_t row) const { return cells_[row]; }  // its number
  // Rows of a task, and tasks of a batch: from here to where the next one begins.
  size_t first_row(size_t task) const { return first_[task]; }
  size_t first_task(size_t batch) const { return batches_[batch]; }
  size_t batches() const { return batches_.size() - 1; }
  size_t tasks() const { return first_.size() - 1; }

 private:
  std::vector<size_t> cells_, first_, batches_;
};

struct Row {
  int64_t rays = 0;
  bool is_new = false;
  Span<const Link> links;  // in those of its task
};

}  // namespace

bool trace_rows(State& state, const StageTools& tools, const RowSettings& settings,
                const LightGrid& grid, const BrightSpots& spots, const std::vector<NodeId>& cells,
                const std::vector<int>& rays_of_cell, StageMemory& memory) {
  const Forest& forest = state.forest;
  const auto is_element = [&](NodeId source) {
    return source >= 0 && static_cast<size_t>(source) < forest.nodes.size() &&
           !Forest::is_cluster(forest.nodes[source]);
  };
  const OwnRows own(state, tools, cells, rays_of_cell);
  state.journal.next_pass();
  bool going_on = own.batches() > 0 || tools.progress(1);  // who has none may stop, too
  for (size_t batch = 0; batch < own.batches() && going_on; ++batch) {
    const size_t first = own.first_task(batch), tasks = own.first_task(batch + 1) - first;
    const size_t first_row = own.first_row(first);
    std::vector<Row> rows(own.first_row(first + tasks) - first_row);
    std::vector<std::vector<Link>> links_of_task(tasks);
    const auto for_each_row = [&](int64_t task, const auto& body) {
      const size_t number = first + static_cast<size_t>(task);
      for (size_t k = own.first_row(number); k < own.first_row(number + 1); ++k)
        body(rows[k - first_row], own.cell(k));
    };
    going_on = state.journal.for_each(
        tools.team, static_cast<int64_t>(tasks),
        [&](int64_t task, int) {
          RowTracer tracer(state, tools, settings, grid, spots);
          std::vector<Link>& links = links_of_task[static_cast<size_t>(task)];
          std::vector<size_t> ends;
          for_each_row(task, [&](Row& row, size_t cell) {
            row.is_new = !state.journal.known_run(name_of_element(forest, cells[cell]), is_element,
                                                  links, row.rays);
            if (row.is_new)
              row.rays = tracer.trace(cells[cell], rays_of_cell[cell], spots.links_to(cell), links);
            ends.push_back(links.size());
          });
          links.shrink_to_fit();
          size_t begin = 0;
          auto end = ends.begin();
          for_each_row(task, [&](Row& row, size_t) {
            row.links = {links.data() + begin, *end - begin};
            begin = *end++;
          });
          const int64_t bytes = static_cast<int64_t>(links.size() * sizeof(Link));
          memory.take(2 * bytes, "rows of rays");  // in two places for a while
        },
        [&](int64_t done) {
          return tools.progress((static_cast<double>(first) + static_cast<double>(done)) /
                                static_cast<double>(own.tasks() + 1));
        },
        [&](LinkStep& step, int64_t task) {
          for_each_row(task, [&](const Row& row, size_t cell) {
            if (row.is_new) step.add_run(name_of_element(forest, cells[cell]), row.links, row.rays);
          });
        });
    if (!going_on) break;
    std::vector<LinkTable::NewRun> runs;
    for (size_t k = 0; k < rows.size(); ++k) {
      state.rays += rows[k].rays;
      runs.push_back({cells[own.cell(first_row + k)], rows[k].links});
    }
    state.links.replace(std::move(runs), &tools.team);
    memory.settle();
  }
  if (!tools.exchange.all_go_on(going_on)) return false;
  tools.exchange.ask_for_sources(state, tools.team);
  memory.settle();
  return true;
}

}  // namespace hrad
