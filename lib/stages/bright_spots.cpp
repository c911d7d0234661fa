// Which leaves are spots, and what their rays meet. Floor 7 (stages).
#include "stages/bright_spots.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/exact_sum.h"
#include "base/hash.h"
#include "machine/pieces.h"
#include "stages/element_rays.h"
#include "stages/exchange.h"
#include "stages/task_names.h"

namespace hrad {
namespace {

// What a leaf must shine over, in units of the mean irradiance: at the most and at the least, and
// in times the mean of all that isn't a spot. Where a few spots have most of the light, noise that
// is little beside them would be much on all else.
constexpr double bright_spot = 2, least_bright_spot = 0.125, times_the_rest = 8;
constexpr double most_rays_of_a_spot = 1 << 20;
// Between middles, in their radii: what is nearer fills so much of the view that rows find it.
constexpr double far_apart = 2;

// Trees of surfaces are looked at in about so many pieces.
constexpr size_t pieces_of_surfaces = 512;

struct Leaf {
  NodeId id;
  float light;
};

// The exposed leaves below a node. light: that of the lowest one above it of which it is known, or
// of the surface if that is more: what chance kept from the few pilot rays of a cell the others on
// its surface have met.
void put_leaves(const Forest& forest, NodeId id, float light, const std::vector<float>& known,
                std::vector<Leaf>& leaves) {
  const NodeId first = forest.nodes.first_child(id);
  const size_t k = static_cast<size_t>(id);
  if (k < known.size() && (first < 0 || static_cast<size_t>(first) >= known.size()))
    light = std::max(light, known[k]);
  if (first < 0 && forest.nodes.exposed(k) > 0) leaves.push_back({id, light});
  for (NodeId child = first; first >= 0 && child < first + 4; ++child)
    put_leaves(forest, child, light, known, leaves);
}

}  // namespace

BrightSpots::BrightSpots(const State& state, const StageTools& tools, const RowSettings& settings,
                         const Brightness& brightness, const Emitters& emitters)
    : state_(state), seed_(mix(settings.seed, 0x73706f74u)), settings_(settings) {
  const Forest& forest = state.forest;
  const std::vector<NodeId>& own_roots = tools.exchange.own_surfaces();
  const std::vector<Leaf> own = gathered<Leaf>(
      tools.team, own_roots.size(),
      [&](size_t k, std::vector<Leaf>& some) {
        if (emitters.of_node(own_roots[k]) < 0)
          put_leaves(forest, own_roots[k], brightness.of_node[own_roots[k]], brightness.of_node,
                     some);
      },
      own_roots.size() / pieces_of_surfaces + 1);
  // Light of all that isn't surely a spot, and area.
  std::vector<std::array<ExactSum, 2>> of_pieces(pieces_of(own.size()));
  for_each_piece(tools.team, own.size(), [&](size_t piece, size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) {
      const double exposed = exposed_area(own[k].id), light = static_cast<double>(own[k].light);
      if (light <= bright_spot) of_pieces[piece][0].add(exposed * light);
      of_pieces[piece][1].add(exposed);
    }
  });
  std::vector<ExactSum> sums(2);
  for (const auto& of_piece : of_pieces)
    for (size_t k = 0; k < 2; ++k) sums[k].add(of_piece[k]);
  tools.exchange.add_up(sums);
  const double rest = sums[0].value(), area = sums[1].value();
  const double least =
      area > 0 ? std::min(bright_spot, std::max(least_bright_spot, times_the_rest * rest / area))
               : bright_spot;
  const double power =
      settings.power_of_spot_rays() * settings.cell_area * std::sqrt(least / bright_spot);
  struct Spot {
    NodeId leaf;
    int32_t rays;
  };
  std::vector<Spot> spots;
  for (const Leaf& leaf : own) {
    const double light = static_cast<double>(leaf.light);
    if (light > least)
      spots.push_back({leaf.id, static_cast<int32_t>(std::ceil(std::min(
                                    most_rays_of_a_spot, light * exposed_area(leaf.id) / power)))});
  }
  tools.exchange.unite(spots);
  std::sort(spots.begin(), spots.end(),
            [](const Spot& a, const Spot& b) { return a.leaf < b.leaf; });
  if (!spots.empty()) rays_.resize(forest.nodes.size(), 0);
  for (const Spot& spot : spots) {
    rays_[spot.leaf] = spot.rays;
    spots_.push_back(spot.leaf);
  }
}

double BrightSpots::exposed_area(NodeId id) const {
  const Node& node = state_.forest.nodes[id];
  return state_.forest.area(node) * node.exposed;
}

bool BrightSpots::sends_to(NodeId leaf, NodeId cell) const {
  if (rays_.empty() || rays_[leaf] == 0) return false;
  const Forest& forest = state_.forest;
  // Rays per area.
  if (rays_[leaf] * exposed_area(cell) <=
      settings_.rays_of(forest.area(forest.nodes[cell])) * exposed_area(leaf))
    return false;
  const Triangle spot = forest.triangle(forest.nodes[leaf]);
  const Triangle around = forest.triangle(forest.nodes[cell]);
  return length(spot.centroid() - around.centroid()) >
         far_apart * (spot.radius() + around.radius());
}

double BrightSpots::rays() const {
  double sum = 0;
  for (NodeId spot : spots_) sum += rays_[spot];
  return sum;
}

// Of those that are traced for, -1: the leaf lies in none.
NodeId BrightSpots::cell_around(NodeId leaf) const {
  NodeId id = leaf;
  while (cell_of_[id] < 0) {
    const Node& node = state_.forest.nodes[id];
    if (node.level == 0) return -1;
    id = node.parent;
  }
  return id;
}

// Appends to met the cells where rays arrive, each with its share of them.
void BrightSpots::send(const StageTools& tools, NodeId spot, std::vector<Link>& met) const {
  const Forest& forest = state_.forest;
  const Node& node = forest.nodes[spot];
  std::vector<NodeId> cells;
  int counted = 0;
  Hit hits[Forest::most_met];
  size_t together = 0;
  const auto take_hits = [&] {
    NodeId leaf[Forest::most_met];
    forest.leaves_met({hits, together}, leaf);
    for (size_t k = 0; k < together; ++k) {
      const NodeId cell = leaf[k] < 0 ? -1 : cell_around(leaf[k]);
      if (cell < 0 || !sends_to(spot, cell)) continue;
      const Surface& surface = forest.surfaces[forest.nodes[cell].surface];
      if (forest.nodes[cell].exposed < 1 &&
          tools.exposure.sealed(surface.patch, surface.side,
                                forest.scene->triangle(hits[k].patch).at(hits[k].u, hits[k].v)))
        continue;
      cells.push_back(cell);
    }
    together = 0;
  };
  ElementRays from(forest, tools.exposure, tools.engine, node, mix(key_of(forest, node), seed_),
                   rays_[spot]);
  for (ElementRays::Ray ray; from.next(ray); ++counted) {
    hits[together++] = tools.engine.nearest(ray.origin, ray.direction, 0);
    if (together == Forest::most_met) take_hits();
  }
  take_hits();
  std::sort(cells.begin(), cells.end());
  for (size_t k = 0; k < cells.size();) {
    const size_t first = k;
    while (k < cells.size() && cells[k] == cells[first]) ++k;
    met.push_back({cells[first], static_cast<float>(static_cast<double>(k - first) / counted)});
  }
}

bool BrightSpots::take(KnownResult& known, std::vector<Link>& met) const {
  std::vector<Link> list;
  const auto is_cell = [&](NodeId id) {
    return id >= 0 && static_cast<size_t>(id) < cell_of_.size() && cell_of_[id] >= 0;
  };
  if (!known.take_list(list) || !known.at_end() || !are_links(list, is_cell)) return false;
  met = std::move(list);
  return true;
}

bool BrightSpots::trace(State& state, const StageTools& tools, const std::vector<NodeId>& cells,
                        StageMemory& memory) {
  if (spots_.empty()) return true;
  const Forest& forest = state.forest;
  memory.take(static_cast<int64_t>(2 * forest.nodes.size() * sizeof(int32_t)), "bright spots");
  cell_of_.assign(forest.nodes.size(), -1);
  for (size_t k = 0; k < cells.size(); ++k)
    if (forest.nodes[cells[k]].exposed > 0) cell_of_[cells[k]] = static_cast<int32_t>(k);
  std::vector<NodeId> own;
  for (NodeId spot : spots_)
    if (tools.exchange.mine(forest.nodes[spot].surface)) own.push_back(spot);
  std::vector<std::vector<Link>> met(own.size());
  const bool going_on = state.journal.next_pass_of(
      tools.team, own.size(),
      {[&](size_t k) { return name_of_element(forest, own[k]); },
       [&](size_t k, KnownResult& known) { return take(known, met[k]); },
       [&](size_t k, int) {
         send(tools, own[k], met[k]);
         memory.take(static_cast<int64_t>(met[k].size() * (sizeof(Link) + 2 * sizeof(Arrival))),
                     "rays from bright spots");
       },
       [&](size_t k, Bytes& bytes) {
         put_list(bytes, Span<const Link>(met[k].data(), met[k].size()));
       }},
      [&](int64_t done) {
        return tools.progress(static_cast<double>(done) / static_cast<double>(own.size() + 1));
      });
  if (!tools.exchange.all_go_on(going_on)) return false;
  std::vector<Arrival> arrivals;
  for (size_t k = 0; k < own.size(); ++k) {
    state.rays += rays_[own[k]];
    for (const Link& share : met[k]) {
      const NodeId cell = share.source;
      const double weight = share.weight * exposed_area(own[k]) / exposed_area(cell);
      arrivals.push_back({cell_of_[cell], {own[k], static_cast<float>(std::min(1.0, weight))}});
    }
  }
  tools.exchange.send_to_owners(
      arrivals, [&](const Arrival& arrival) { return forest.nodes[cells[arrival.cell]].surface; });
  deal_out(arrivals, cells.size());
  return true;
}

// To the cells, so many.
void BrightSpots::deal_out(std::vector<Arrival>& arrivals, size_t cells) {
  std::sort(arrivals.begin(), arrivals.end(), [](const Arrival& a, const Arrival& b) {
    return a.cell != b.cell ? a.cell < b.cell : a.link.source < b.link.source;
  });
  first_.assign(cells + 1, 0);
  links_.clear();
  for (const Arrival& arrival : arrivals) {
    ++first_[static_cast<size_t>(arrival.cell) + 1];
    links_.push_back(arrival.link);
  }
  for (size_t k = 0; k < cells; ++k) first_[k + 1] += first_[k];
}

}  // namespace hrad
