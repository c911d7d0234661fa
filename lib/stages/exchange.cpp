// Requests, updates and totals. Floor 7 (stages).
#include "stages/exchange.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <utility>

#include "machine/pieces.h"

namespace hrad {
namespace {

enum Kind { requests, updates, totals };

}  // namespace

Exchange::Exchange(Comm& comm, std::vector<int32_t> owner_of_surface) : comm_(comm) {
  deal_out(std::move(owner_of_surface));
}

void Exchange::deal_out(std::vector<int32_t> owner_of_surface) {
  owner_ = std::move(owner_of_surface);
  own_.clear();
  for (size_t surface = 0; surface < owner_.size(); ++surface)
    if (is_me(owner_[surface])) own_.push_back(static_cast<int32_t>(surface));
  forget_requests();
}

void Exchange::forget_requests() {
  asked_.clear();
  asked_of_.assign(static_cast<size_t>(comm_.size()), {});
  asked_by_ = asked_of_;
}

// Of an exchange with every other process, one message for each that has something to be told.
void Exchange::count(int kind, const std::vector<Bytes>& sent) {
  for (int rank = 0; rank < static_cast<int>(sent.size()); ++rank) {
    if (rank == comm_.rank() || sent[rank].empty()) continue;
    ++counts_.messages[kind];
    counts_.bytes[kind] += static_cast<int64_t>(sent[rank].size());
  }
}

void Exchange::forget(State& state) {
  forget_requests();
  state.places = LightPlaces();
  make_room_for_light(state);
}

void Exchange::make_places_for_light(State& state) const {
  LightPlaces& places = state.places;
  const NodeArray& nodes = state.forest.nodes;
  if (!alone() && (places.of_all() || places.first_element() != nodes.first_element()))
    places.keep_some(nodes.first_element());
  size_t first = places.nodes();
  places.resize(nodes.size());
  if (!alone())
    for (; first < nodes.size(); first += 4)
      if (mine(nodes[first].surface)) places.add_own_family(static_cast<NodeId>(first));
}

void Exchange::keep_own_light(State& state, const float* radiosity, const float* irradiance) const {
  state.places = LightPlaces();
  make_room_for_light(state);
  const size_t bands = static_cast<size_t>(state.bands);
  const auto keep = [&](size_t id, size_t place, size_t count) {
    std::copy_n(radiosity + id * bands, count * bands, &state.radiosity[place * bands]);
    std::copy_n(irradiance + id * bands, count * bands, &state.irradiance[place * bands]);
  };
  state.places.for_each_stretch(0, state.forest.nodes.size(), keep);
}

namespace {

using PlaceList = std::vector<uint32_t>;

// body(rank, k) for each of each rank's places.
template <class Body>
void for_each_place(ThreadTeam& team, const std::vector<PlaceList>& of_ranks, const Body& body) {
  std::vector<size_t> first(1, 0);  // of each rank, one after the other
  for (const PlaceList& places : of_ranks) first.push_back(first.back() + places.size());
  for_each_piece(team, first.back(), [&](size_t, size_t begin, size_t end) {
    size_t rank = 0;
    for (size_t k = begin; k < end; ++k) {
      while (k >= first[rank + 1]) ++rank;
      body(rank, k - first[rank]);
    }
  });
}

// One by one: they are few, and their number is not known to the compiler.
void copy_values(const void* from, size_t count, void* to) {
  for (size_t at = 0; at < count * sizeof(float); at += sizeof(float))
    std::memcpy(static_cast<char*>(to) + at, static_cast<const char*>(from) + at, sizeof(float));
}

std::vector<Bytes> radiosity_at(const State& state, ThreadTeam& team,
                                const std::vector<PlaceList>& places) {
  const size_t bands = static_cast<size_t>(state.bands), bytes = bands * sizeof(float);
  std::vector<Bytes> to(places.size());
  for (size_t rank = 0; rank < to.size(); ++rank) to[rank].resize(places[rank].size() * bytes);
  for_each_place(team, places, [&](size_t rank, size_t k) {
    copy_values(&state.radiosity[places[rank][k] * bands], bands, &to[rank][k * bytes]);
  });
  return to;
}

void take_radiosity(State& state, ThreadTeam& team, const std::vector<PlaceList>& places,
                    const std::vector<Bytes>& from) {
  const size_t bands = static_cast<size_t>(state.bands), bytes = bands * sizeof(float);
  for_each_place(team, places, [&](size_t rank, size_t k) {
    copy_values(&from[rank][k * bytes], bands, &state.radiosity[places[rank][k] * bands]);
  });
}

}  // namespace

void Exchange::ask_for_sources(State& state, ThreadTeam& team) {
  if (alone()) return;
  make_places_for_light(state);
  const Forest& forest = state.forest;
  std::vector<std::atomic<uint8_t>> is_source(forest.nodes.size());
  for (const LinkTable* table : {&state.links, &state.direct.mean})
    team.for_each(static_cast<int64_t>(table->block_count()), [&](int64_t block, int) {
      for (const Link& link : table->block(static_cast<size_t>(block)).links)
        is_source[static_cast<size_t>(link.source)].store(1, std::memory_order_relaxed);
    });
  // Clusters, and the roots that they are made of, are known.
  const auto is_known = [](const Node& node) {
    return Forest::is_cluster(node) || (node.level == 0 && node.parent >= 0);
  };
  asked_.resize(forest.nodes.size(), false);
  const std::vector<NodeId> of_others =
      gathered<NodeId>(team, forest.nodes.size(), [&](size_t k, std::vector<NodeId>& some) {
        if (!is_source[k].load(std::memory_order_relaxed) || asked_[k]) return;
        const Node& node = forest.nodes[k];
        if (!is_known(node) && !mine(node.surface)) some.push_back(static_cast<NodeId>(k));
      });
  std::vector<std::vector<NodeId>> wanted(asked_of_.size());
  const NodeId first_element = static_cast<NodeId>(forest.nodes.first_element());
  for (NodeId source : of_others) {
    asked_[static_cast<size_t>(source)] = true;
    wanted[owner_[forest.nodes[source].surface]].push_back(source);
    if (source >= first_element) state.places.add_family(source - (source - first_element) % 4);
  }
  state.resize_light();
  std::vector<Bytes> to(wanted.size());
  for (size_t rank = 0; rank < wanted.size(); ++rank)
    put(to[rank], wanted[rank].data(), wanted[rank].size());
  count(requests, to);
  const std::vector<Bytes> from = comm_.exchange(std::move(to));
  const auto places_of = [&](const std::vector<NodeId>& elements) {
    PlaceList places;
    places.reserve(elements.size());
    for (NodeId id : elements) places.push_back(static_cast<uint32_t>(state.places[id]));
    return places;
  };
  std::vector<PlaceList> of(wanted.size()), by(from.size());
  for (size_t rank = 0; rank < from.size(); ++rank) {
    std::vector<NodeId> wanted_by(from[rank].size() / sizeof(NodeId));
    Taker(from[rank]).take(wanted_by.data(), wanted_by.size());
    of[rank] = places_of(wanted[rank]);
    by[rank] = places_of(wanted_by);
  }
  std::vector<Bytes> told = radiosity_at(state, team, by);
  count(updates, told);
  take_radiosity(state, team, of, comm_.exchange(std::move(told)));
  for (size_t rank = 0; rank < from.size(); ++rank) {
    asked_of_[rank].insert(asked_of_[rank].end(), of[rank].begin(), of[rank].end());
    asked_by_[rank].insert(asked_by_[rank].end(), by[rank].begin(), by[rank].end());
  }
}

void Exchange::start_update(const State& state, ThreadTeam& team) {
  if (alone()) return;
  std::vector<Bytes> to = radiosity_at(state, team, asked_by_);
  count(updates, to);
  comm_.start_exchange(std::move(to));
}

void Exchange::finish_update(State& state, ThreadTeam& team) {
  if (!comm_.exchanging()) return;
  take_radiosity(state, team, asked_of_, comm_.finish_exchange());
}

// MPI moves large messages only within its own functions.
void Exchange::make_progress() const {
  if (comm_.exchanging()) comm_.raised();
}

void Exchange::count_totals(int64_t bytes) {
  if (bytes == 0) return;
  counts_.messages[totals] += comm_.size() - 1;
  counts_.bytes[totals] += bytes * (comm_.size() - 1);
}

void Exchange::add_up(std::vector<ExactSum>& sums) const {
  if (alone()) return;
  std::vector<ExactSum::Digits> digits;
  for (const ExactSum& sum : sums) digits.push_back(sum.digits());
  comm_.add_up({digits.front().data(), digits.size() * digits.front().size()});
  for (size_t k = 0; k < sums.size(); ++k) sums[k] = ExactSum(digits[k]);
}

void Exchange::add_up_transported(std::vector<ExactSum>& sums) {
  add_up(sums);
  if (!alone()) count_totals(static_cast<int64_t>(sums.size() * sizeof(ExactSum::Digits)));
}

namespace {

// Radiosity and irradiance of some roots, node_of(k), as rows of bytes.
template <class OwnerOf, class NodeOf>
size_t share_light_of(Comm& comm, ThreadTeam& team, State& state, size_t count,
                      const OwnerOf& owner_of, const NodeOf& node_of) {
  const size_t bytes = static_cast<size_t>(state.bands) * sizeof(float);
  return share_rows(
      comm, team, count, 2 * bytes, owner_of,
      [&](size_t k, char* to) {
        std::memcpy(to, state.radiosity_of(node_of(k)), bytes);
        std::memcpy(to + bytes, state.irradiance_of(node_of(k)), bytes);
      },
      [&](size_t k, const char* from) {
        std::memcpy(state.radiosity_of(node_of(k)), from, bytes);
        std::memcpy(state.irradiance_of(node_of(k)), from + bytes, bytes);
      });
}

}  // namespace

void Exchange::share_roots(State& state, ThreadTeam& team) {
  const size_t sent = share_light_of(
      comm_, team, state, owner_.size(), [&](size_t root) { return owner_[root]; },
      [](size_t root) { return static_cast<NodeId>(root); });
  count_totals(static_cast<int64_t>(sent));
}

void Exchange::share_roots_of_clusters(State& state, ThreadTeam& team) {
  const std::vector<int32_t>& roots = state.forest.clusters.order;
  const size_t sent = share_light_of(
      comm_, team, state, roots.size(), [&](size_t k) { return owner_[roots[k]]; },
      [&](size_t k) { return roots[k]; });
  count_totals(static_cast<int64_t>(sent));
}

}  // namespace hrad
