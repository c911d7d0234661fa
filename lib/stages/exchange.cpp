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
  forget();
}

void Exchange::forget() {
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

void Exchange::ask_for_sources(const State& state, ThreadTeam& team) {
  if (alone()) return;
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
  asked_.resize(forest.nodes.size(), 0);
  const std::vector<NodeId> of_others =
      gathered<NodeId>(team, forest.nodes.size(), [&](size_t k, std::vector<NodeId>& some) {
        if (!is_source[k].load(std::memory_order_relaxed) || asked_[k]) return;
        const Node& node = forest.nodes[k];
        if (is_known(node) || mine(node.surface)) return;
        asked_[k] = 1;
        some.push_back(static_cast<NodeId>(k));
      });
  std::vector<std::vector<NodeId>> wanted(asked_of_.size());
  for (NodeId source : of_others) wanted[owner_[forest.nodes[source].surface]].push_back(source);
  std::vector<Bytes> to(wanted.size());
  for (size_t rank = 0; rank < wanted.size(); ++rank) {
    put(to[rank], wanted[rank].data(), wanted[rank].size());
    asked_of_[rank].insert(asked_of_[rank].end(), wanted[rank].begin(), wanted[rank].end());
  }
  count(requests, to);
  const std::vector<Bytes> from = comm_.exchange(std::move(to));
  for (size_t rank = 0; rank < from.size(); ++rank) {
    const size_t more = from[rank].size() / sizeof(NodeId), before = asked_by_[rank].size();
    asked_by_[rank].resize(before + more);
    Taker(from[rank]).take(asked_by_[rank].data() + before, more);
  }
}

namespace {

// body(rank, k) for each element of each rank's list.
template <class Body>
void for_each_asked(ThreadTeam& team, const std::vector<std::vector<NodeId>>& of_ranks,
                    const Body& body) {
  std::vector<size_t> first(1, 0);  // of each rank, one after the other
  for (const std::vector<NodeId>& elements : of_ranks)
    first.push_back(first.back() + elements.size());
  for_each_piece(team, first.back(), [&](size_t, size_t begin, size_t end) {
    size_t rank = 0;
    for (size_t k = begin; k < end; ++k) {
      while (k >= first[rank + 1]) ++rank;
      body(rank, k - first[rank]);
    }
  });
}

}  // namespace

void Exchange::start_update(const State& state, ThreadTeam& team) {
  if (alone()) return;
  const size_t bands = static_cast<size_t>(state.bands), bytes = bands * sizeof(float);
  std::vector<Bytes> to(asked_by_.size());
  for (size_t rank = 0; rank < to.size(); ++rank) to[rank].resize(asked_by_[rank].size() * bytes);
  for_each_asked(team, asked_by_, [&](size_t rank, size_t k) {
    const size_t at = static_cast<size_t>(asked_by_[rank][k]) * bands;
    std::memcpy(&to[rank][k * bytes], &state.radiosity[at], bytes);
  });
  count(updates, to);
  comm_.start_exchange(std::move(to));
}

void Exchange::finish_update(State& state, ThreadTeam& team) {
  if (!comm_.exchanging()) return;
  const size_t bands = static_cast<size_t>(state.bands), bytes = bands * sizeof(float);
  const std::vector<Bytes> from = comm_.finish_exchange();
  for_each_asked(team, asked_of_, [&](size_t rank, size_t k) {
    const size_t at = static_cast<size_t>(asked_of_[rank][k]) * bands;
    std::memcpy(&state.radiosity[at], &from[rank][k * bytes], bytes);
  });
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

void Exchange::add_up(std::vector<ExactSum>& sums) {
  if (alone()) return;
  std::vector<ExactSum::Digits> digits;
  for (const ExactSum& sum : sums) digits.push_back(sum.digits());
  const size_t numbers = digits.size() * digits.front().size();
  count_totals(static_cast<int64_t>(numbers * sizeof(uint64_t)));
  comm_.add_up({digits.front().data(), numbers});
  for (size_t k = 0; k < sums.size(); ++k) sums[k] = ExactSum(digits[k]);
}

namespace {

// Radiosity and irradiance of some nodes, node_of(k), as rows of bytes.
template <class OwnerOf, class NodeOf>
size_t share_light_of(Comm& comm, ThreadTeam& team, State& state, size_t count,
                      const OwnerOf& owner_of, const NodeOf& node_of) {
  const size_t bands = static_cast<size_t>(state.bands), bytes = bands * sizeof(float);
  return share_rows(
      comm, team, count, 2 * bytes, owner_of,
      [&](size_t k, char* to) {
        const size_t at = node_of(k) * bands;
        std::memcpy(to, &state.radiosity[at], bytes);
        std::memcpy(to + bytes, &state.irradiance[at], bytes);
      },
      [&](size_t k, const char* from) {
        const size_t at = node_of(k) * bands;
        std::memcpy(&state.radiosity[at], from, bytes);
        std::memcpy(&state.irradiance[at], from + bytes, bytes);
      });
}

}  // namespace

void Exchange::share_roots(State& state, ThreadTeam& team) {
  const size_t sent = share_light_of(
      comm_, team, state, owner_.size(), [&](size_t root) { return owner_[root]; },
      [](size_t root) { return root; });
  count_totals(static_cast<int64_t>(sent));
}

void Exchange::share_roots_of_clusters(State& state, ThreadTeam& team) {
  const std::vector<int32_t>& roots = state.forest.clusters.order;
  const size_t sent = share_light_of(
      comm_, team, state, roots.size(), [&](size_t k) { return owner_[roots[k]]; },
      [&](size_t k) { return static_cast<size_t>(roots[k]); });
  count_totals(static_cast<int64_t>(sent));
}

void Exchange::share_light(State& state, ThreadTeam& team) const {
  if (alone()) return;
  const Forest& forest = state.forest;
  // Between the roots and the elements there are clusters.
  const size_t roots = owner_.size(), clusters = forest.clusters.clusters.size();
  const auto node_of = [&](size_t k) { return k < roots ? k : k + clusters; };
  share_light_of(
      comm_, team, state, forest.nodes.size() - clusters,
      [&](size_t k) { return owner_[forest.nodes[node_of(k)].surface]; }, node_of);
}

}  // namespace hrad
