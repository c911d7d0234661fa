// Requests, updates and totals. Floor 7 (stages).
#include "stages/exchange.h"

#include <utility>

namespace hrad {
namespace {

enum Kind { requests, updates, totals };

}  // namespace

Exchange::Exchange(Comm& comm, std::vector<int32_t> owner_of_surface)
    : comm_(comm), owner_(std::move(owner_of_surface)) {
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

void Exchange::ask_for_sources(const State& state) {
  if (alone()) return;
  const Forest& forest = state.forest;
  asked_.resize(forest.nodes.size(), 0);
  std::vector<std::vector<NodeId>> wanted(asked_of_.size());
  for (size_t block = 0; block < state.links.block_count(); ++block) {
    for (const Link& link : state.links.block(block).links) {
      const NodeId source = link.source;
      const Node& node = forest.nodes[source];
      // Roots are known to all, and clusters are made of them.
      if (node.level == 0 || asked_[source] || mine(node.surface)) continue;
      asked_[source] = 1;
      wanted[owner_[node.surface]].push_back(source);
    }
  }
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

void Exchange::update(State& state) {
  if (alone()) return;
  const size_t bands = static_cast<size_t>(state.bands);
  std::vector<Bytes> to(asked_by_.size());
  for (size_t rank = 0; rank < to.size(); ++rank) {
    to[rank].reserve(asked_by_[rank].size() * bands * sizeof(float));
    for (NodeId id : asked_by_[rank])
      put(to[rank], &state.radiosity[static_cast<size_t>(id) * bands], bands);
  }
  count(updates, to);
  const std::vector<Bytes> from = comm_.exchange(std::move(to));
  for (size_t rank = 0; rank < from.size(); ++rank) {
    Taker taker(from[rank]);
    for (NodeId id : asked_of_[rank])
      taker.take(&state.radiosity[static_cast<size_t>(id) * bands], bands);
  }
}

void Exchange::share_roots(State& state, std::vector<double>& rows) {
  if (alone()) return;
  const size_t bands = static_cast<size_t>(state.bands);
  int64_t sent = 0;
  hrad::share(
      comm_, owner_.size(), [&](size_t root) { return owner_[root]; },
      [&](size_t root, Bytes& bytes) {
        const size_t before = bytes.size();
        put(bytes, &rows[root * bands], bands);
        put(bytes, &state.radiosity[root * bands], bands);
        put(bytes, &state.irradiance[root * bands], bands);
        sent += static_cast<int64_t>(bytes.size() - before);
      },
      [&](size_t root, Taker& taker) {
        taker.take(&rows[root * bands], bands);
        taker.take(&state.radiosity[root * bands], bands);
        taker.take(&state.irradiance[root * bands], bands);
      });
  if (sent == 0) return;
  counts_.messages[totals] += comm_.size() - 1;
  counts_.bytes[totals] += sent * (comm_.size() - 1);
}

void Exchange::share_light(State& state) const {
  if (alone()) return;
  const size_t bands = static_cast<size_t>(state.bands);
  std::vector<NodeId> elements;
  for (size_t id = 0; id < state.forest.nodes.size(); ++id)
    if (!Forest::is_cluster(state.forest.nodes[id])) elements.push_back(static_cast<NodeId>(id));
  const auto both = [&](size_t k, const auto& pass) {
    const size_t at = static_cast<size_t>(elements[k]) * bands;
    pass(&state.radiosity[at]);
    pass(&state.irradiance[at]);
  };
  hrad::share(
      comm_, elements.size(),
      [&](size_t k) { return owner_[state.forest.nodes[elements[k]].surface]; },
      [&](size_t k, Bytes& bytes) {
        both(k, [&](const float* values) { put(bytes, values, bands); });
      },
      [&](size_t k, Taker& taker) { both(k, [&](float* values) { taker.take(values, bands); }); });
}

}  // namespace hrad
