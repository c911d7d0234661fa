// Every owner's runs, one after the other in the order of the nodes. Floor 8 (solver).
#include "solver/all_links.h"

#include <algorithm>
#include <utility>

#include "stages/point_numbers.h"

namespace hrad {
namespace {

// What of a leaf's points is said: numbers are the owner's own, new ones in turn.
struct PointHead {
  int32_t number;
  uint8_t is_new, has_place;
  float x, y;
};

void put_points(Bytes& bytes, const State& state, NodeId id, int32_t& known) {
  const CornerLight& direct = state.direct;
  const auto& points = direct.of_leaf[static_cast<size_t>(id)];
  const uint8_t any = points[0] >= 0;
  put(bytes, &any, 1);
  if (!any) return;
  const CornerLight::OwnPoint* own = own_points(state, id);
  for (int c = 0; c < 3; ++c) {
    PointHead head = {};
    head.number = points[c];
    head.is_new = points[c] == known;
    head.has_place = own != nullptr;
    if (own) {
      head.x = own[c].x;
      head.y = own[c].y;
    }
    put(bytes, &head, 1);
    if (!head.is_new) continue;
    ++known;
    put_list(bytes, direct.links_of_point(points[c]));
  }
}

// number: of the owner's points here.
void take_points(Taker& taker, CornerLight& direct, NodeId id, std::vector<int32_t>& number) {
  uint8_t any;
  taker.take(&any, 1);
  if (!any) return;
  std::vector<Link> run;
  for (int c = 0; c < 3; ++c) {
    PointHead head;
    taker.take(&head, 1);
    if (head.is_new) {
      number.push_back(static_cast<int32_t>(direct.point_count()));
      take_list(taker, run);
      direct.links.insert(direct.links.end(), run.begin(), run.end());
      direct.first.push_back(static_cast<uint32_t>(direct.links.size()));
      if (head.has_place) direct.own.push_back({number.back(), head.x, head.y});
    }
    direct.of_leaf[static_cast<size_t>(id)][c] = number[static_cast<size_t>(head.number)];
  }
}

Bytes own_part(const State& state, const Exchange& exchange) {
  const CornerLight& direct = state.direct;
  Bytes bytes;
  int32_t known = 0;
  for (size_t k = 0; k < state.forest.nodes.size(); ++k) {
    const Node& node = state.forest.nodes[k];
    if (Forest::is_cluster(node) || !exchange.mine(node.surface)) continue;
    put(bytes, &node.light_points, 1);
    put_list(bytes, state.links[k].links());
    if (k < direct.mean.size()) put_list(bytes, direct.mean[k].links());
    if (k < direct.of_leaf.size()) put_points(bytes, state, static_cast<NodeId>(k), known);
  }
  return bytes;
}

}  // namespace

AllLinks::AllLinks(State& state, const Exchange& exchange) : state_(state) {
  if (exchange.alone()) return;
  Comm& comm = exchange.comm();
  std::vector<Bytes> to(static_cast<size_t>(comm.size()));
  to[0] = own_part(state, exchange);
  const std::vector<Bytes> from = comm.exchange(std::move(to));
  if (comm.rank() != 0) return;
  std::vector<Taker> takers_of = takers(from);
  std::vector<std::vector<int32_t>> number(from.size());
  if (!state.direct.first.empty()) direct_.first.push_back(0);
  direct_.of_leaf.resize(state.direct.of_leaf.size(), {-1, -1, -1});
  std::vector<Link> run;
  for (size_t k = 0; k < state.forest.nodes.size(); ++k) {
    Node& node = state.forest.nodes[k];
    if (Forest::is_cluster(node)) {
      links_.append(state.links[k].links());
      if (k < state.direct.mean.size()) direct_.mean.append({});
      continue;
    }
    const size_t owner = static_cast<size_t>(exchange.owner(node.surface));
    Taker& taker = takers_of[owner];
    taker.take(&node.light_points, 1);
    take_list(taker, run);
    links_.append(run);
    if (k < state.direct.mean.size()) {
      take_list(taker, run);
      direct_.mean.append(run);
    }
    if (k < direct_.of_leaf.size())
      take_points(taker, direct_, static_cast<NodeId>(k), number[owner]);
  }
  swap();
  swapped_ = true;
}

AllLinks::~AllLinks() {
  if (swapped_) swap();
}

void AllLinks::swap() {
  std::swap(state_.links, links_);
  std::swap(state_.direct, direct_);
}

void keep_own_links(State& state, const Exchange& exchange) {
  if (exchange.alone()) return;
  const auto is_mine = [&](NodeId id) {
    const Node& node = state.forest.nodes[static_cast<size_t>(id)];
    return Forest::is_cluster(node) || exchange.mine(node.surface);
  };
  for (LinkTable* table : {&state.links, &state.direct.mean}) {
    std::vector<LinkTable::NewRun> none;
    for (size_t k = 0; k < table->size(); ++k)
      if (!is_mine(static_cast<NodeId>(k)) && (*table)[k].count() > 0)
        none.push_back({static_cast<NodeId>(k), {}});
    table->replace(std::move(none));
  }
  if (!state.direct.of_leaf.empty())
    number_points_by_leaves(state.direct, is_mine, [](int32_t, const Link&) { return true; });
}

}  // namespace hrad
