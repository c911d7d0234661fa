// When to move, and moving. Floor 7 (stages).
#include "stages/rebalance.h"

#include <algorithm>
#include <utility>

#include "partition/partition.h"
#include "stages/light_of_all.h"
#include "stages/state_memory.h"

namespace hrad {
namespace {

// Of the largest load; and what it takes to move a link, in what refining one takes.
constexpr double least_gain = 0.02, work_of_a_move = 0.02;

double largest_load(const std::vector<double>& work, const std::vector<int32_t>& owners,
                    int ranks) {
  std::vector<double> load(static_cast<size_t>(ranks), 0.0);
  for (size_t k = 0; k < work.size(); ++k) load[static_cast<size_t>(owners[k])] += work[k];
  return *std::max_element(load.begin(), load.end());
}

std::vector<int32_t> owners_by(const State& state, const std::vector<double>& work, int ranks) {
  const Scene& scene = *state.forest.scene;
  const std::vector<Surface>& surfaces = state.forest.surfaces;
  std::vector<double> of_patch(static_cast<size_t>(scene.patch_count()), 0.0);
  for (size_t k = 0; k < work.size(); ++k)
    of_patch[static_cast<size_t>(surfaces[k].patch)] += work[k];
  const std::vector<PartitionItem> items = partition_items(scene, of_patch);
  const std::vector<int32_t> owners =
      owners_of(scene, items, partition_method("cost").divide(items, ranks));
  std::vector<int32_t> of_surface;
  for (const Surface& surface : surfaces)
    of_surface.push_back(owners[static_cast<size_t>(surface.patch)]);
  return of_surface;
}

// Runs of elements whose surface has another owner now.
void move_links(State& state, ThreadTeam& team, Exchange& exchange, std::vector<int32_t> owners) {
  Comm& comm = exchange.comm();
  const NodeArray& nodes = state.forest.nodes;
  std::vector<Bytes> to(static_cast<size_t>(comm.size()));
  std::vector<LinkTable::NewRun> runs;
  for (size_t k = 0; k < nodes.size(); ++k) {
    if (Forest::is_cluster(nodes[k]) || !exchange.mine(nodes[k].surface)) continue;
    const int32_t next = owners[static_cast<size_t>(nodes[k].surface)];
    if (next == comm.rank()) continue;
    const Span<const Link> run = state.links[k].links();
    put_list(to[static_cast<size_t>(next)], run);
    if (!run.empty()) runs.push_back({static_cast<NodeId>(k), {}});
  }
  const LightOfAll radiosity(state, &State::radiosity, exchange, team);
  const LightOfAll irradiance(state, &State::irradiance, exchange, team);
  const std::vector<Bytes> from = comm.exchange(std::move(to));
  std::vector<Taker> taken = takers(from);
  std::vector<std::vector<Link>> arrived;
  std::vector<NodeId> receivers;
  for (size_t k = 0; k < nodes.size(); ++k) {
    if (Forest::is_cluster(nodes[k]) || exchange.mine(nodes[k].surface)) continue;
    if (owners[static_cast<size_t>(nodes[k].surface)] != comm.rank()) continue;
    arrived.emplace_back();
    take_list(taken[static_cast<size_t>(exchange.owner(nodes[k].surface))], arrived.back());
    if (arrived.back().empty())
      arrived.pop_back();
    else
      receivers.push_back(static_cast<NodeId>(k));
  }
  for (size_t k = 0; k < receivers.size(); ++k) runs.push_back({receivers[k], arrived[k]});
  counted(state, [&] {
    state.links.replace(std::move(runs), &team);
    exchange.deal_out(std::move(owners));
    exchange.keep_own_light(state, radiosity[0], irradiance[0]);
    exchange.ask_for_sources(state, team);
    shrink_to_fit(state);
  });
}

}  // namespace

std::vector<double> links_of_surfaces(const State& state, const Exchange& exchange) {
  std::vector<double> links(state.forest.surfaces.size(), 0.0);
  for (size_t k = 0; k < state.forest.nodes.size(); ++k) {
    const Node& node = state.forest.nodes[k];
    if (!Forest::is_cluster(node) && exchange.mine(node.surface))
      links[static_cast<size_t>(node.surface)] += state.links[k].count();
  }
  return links;
}

void rebalance(State& state, ThreadTeam& team, Exchange& exchange, std::vector<double> work) {
  if (exchange.alone()) return;
  const int ranks = exchange.comm().size();
  std::vector<double> links = links_of_surfaces(state, exchange);
  const auto itself = [](size_t k) { return static_cast<int32_t>(k); };
  exchange.share(work, itself, team);
  exchange.share(links, itself, team);
  std::vector<int32_t> owners = owners_by(state, work, ranks);
  double moved = 0, all_links = 0, all_work = 0;
  for (size_t k = 0; k < owners.size(); ++k) {
    if (owners[k] != exchange.owner(static_cast<int32_t>(k))) moved += links[k];
    all_links += links[k];
    all_work += work[k];
  }
  if (!(all_links > 0)) return;
  const double before = largest_load(work, exchange.owners(), ranks);
  const double gain = before - largest_load(work, owners, ranks);
  if (!(gain > least_gain * before && gain > work_of_a_move * moved / ranks * all_work / all_links))
    return;
  move_links(state, team, exchange, std::move(owners));
}

}  // namespace hrad
