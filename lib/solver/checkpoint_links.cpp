// A run is packed by one process, with what the others hand it. Floor 8 (solver).
#include "solver/checkpoint_links.h"

#include <array>

#include "solver/all_points.h"
#include "solver/checkpoint_light.h"
#include "solver/checkpoint_runs.h"
#include "solver/checkpoint_tree.h"
#include "solver/items_of_others.h"
#include "stages/exchange.h"

namespace hrad {
namespace {

class LinkWriter {
 public:
  LinkWriter(CheckpointSink& sink, const CheckpointView& view)
      : sink_(sink),
        comm_(view.exchange->comm()),
        state_(*view.state),
        direct_(view.state->direct),
        exchange_(*view.exchange),
        points_(*view.points) {}

  void links_of_nodes(Section section, int64_t receivers, const LinkTable& links) {
    runs(
        section, receivers, [this](int64_t k) { return owner_of_node(k); },
        [&](int64_t k) { return links[static_cast<size_t>(k)].links(); });
  }
  void points(int64_t leaves) {
    const auto own = [this](int64_t k) { return points_.of_leaf(direct_, k); };
    ItemsOfOthers<LeafPoints::Numbers> others(
        comm_, [this](int64_t k) { return owner_of_node(k); },
        [&](int64_t k, std::vector<LeafPoints::Numbers>& list) { list.push_back(own(k)); });
    const PointsOf points_of = [&](int64_t k) { return others.mine(k) ? own(k) : others[k][0]; };
    write(Section::points, leaves, others, [&](int64_t first, int64_t end, PackedBytes& bytes) {
      pack_points(state_.forest, first, end, points_of, bytes);
    });
  }
  void links_of_points() {
    const Places& points = points_.points();
    runs(
        Section::point_links, points.count(), [&](int64_t k) { return points.owner(k); },
        [&](int64_t k) { return direct_.links_of_point(static_cast<int32_t>(points.own(k))); });
  }
  void own_points() {
    const Places &points = points_.points(), &own_points = points_.own_points();
    const auto own = [&](int64_t k) {
      const size_t own_one = own_points.own(k), leaf = own_one / 3, c = own_one % 3;
      const size_t number = static_cast<size_t>(direct_.of_leaf.first_own(leaf)) + c;
      return OwnPoint{static_cast<int32_t>(points.place(number)), direct_.of_leaf.own(leaf)[c]};
    };
    ItemsOfOthers<OwnPoint> others(
        comm_, [&](int64_t k) { return own_points.owner(k); },
        [&](int64_t k, std::vector<OwnPoint>& list) { list.push_back(own(k)); });
    const OwnPointAt point_at = [&](int64_t k) { return others.mine(k) ? own(k) : others[k][0]; };
    write(Section::own_points, own_points.count(), others,
          [&](int64_t first, int64_t end, PackedBytes& bytes) {
            pack_own_points(first, end, point_at, bytes);
          });
  }

 private:
  int32_t owner_of_node(int64_t k) const {
    return exchange_.owner(Exchange::surface_of(state_.forest, static_cast<NodeId>(k)));
  }
  template <class Part>
  void write(Section section, int64_t items, ItemsOfOthers<Part>& others,
             const CheckpointSink::Pack& pack) {
    sink_.write(section, items, pack,
                [&](const std::vector<ItemRange>& of_rank) { others.fetch(of_rank); });
  }
  void runs(Section section, int64_t receivers, const ItemsOfOthers<Link>::OwnerOf& owner_of,
            const RunOf& own_run) {
    ItemsOfOthers<Link> others(comm_, owner_of, [&](int64_t k, std::vector<Link>& list) {
      const Span<const Link> run = own_run(k);
      list.assign(run.begin(), run.end());
    });
    const RunOf run_of = [&](int64_t k) { return others.mine(k) ? own_run(k) : others[k]; };
    write(section, receivers, others, [&](int64_t first, int64_t end, PackedBytes& bytes) {
      pack_runs(first, end, run_of, bytes);
    });
  }

  CheckpointSink& sink_;
  Comm& comm_;
  const State& state_;
  const CornerLight& direct_;
  const Exchange& exchange_;
  const AllPoints& points_;
};

}  // namespace

void add_up(Comm& comm, const CheckpointView& view, CheckpointSizes& sizes) {
  if (comm.alone()) return;
  uint64_t links = 0, mean_links = 0;
  if (view.state) {
    const State& state = *view.state;
    const LinkTable& mean = state.direct.mean;
    for (size_t k = 0; k < state.links.size(); ++k) {
      // Every process may know those of a cluster.
      if (!view.exchange->mine(state.forest, static_cast<NodeId>(k))) continue;
      links += static_cast<uint64_t>(state.links[k].count());
      if (k < mean.size()) mean_links += static_cast<uint64_t>(mean[k].count());
    }
    sizes.points = view.points->points().count();
    sizes.own_points = view.points->own_points().count();
  }
  uint64_t sums[] = {links, mean_links, static_cast<uint64_t>(sizes.point_links),
                     static_cast<uint64_t>(sizes.steps)};
  comm.add_up({sums, 4});
  sizes.links = static_cast<int64_t>(sums[0]);
  sizes.mean_links = static_cast<int64_t>(sums[1]);
  sizes.point_links = static_cast<int64_t>(sums[2]);
  sizes.steps = static_cast<int64_t>(sums[3]);
}

void write_links(CheckpointSink& sink, const CheckpointView& view, const CheckpointSizes& sizes) {
  LinkWriter writer(sink, view);
  const State& state = *view.state;
  writer.links_of_nodes(Section::links, sizes.nodes(), state.links);
  sink.write(Section::cells, sizes.cells, [&](int64_t first, int64_t end, PackedBytes& bytes) {
    pack_cells(state.cells, first, end, bytes);
  });
  writer.links_of_nodes(Section::mean_light, sizes.receivers_of_means, state.direct.mean);
  writer.points(sizes.leaves_of_points);
  writer.links_of_points();
  writer.own_points();
}

void write_no_links(CheckpointSink& sink) {
  for (Section section : {Section::links, Section::cells, Section::mean_light, Section::points,
                          Section::point_links, Section::own_points})
    sink.write(section, 0, nullptr);
}

}  // namespace hrad
