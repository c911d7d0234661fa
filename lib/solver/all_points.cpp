// Every owner tells how many new points its leaves name. Floor 8 (solver).
#include "solver/all_points.h"

#include <algorithm>

namespace hrad {
namespace {

// What is told of an element, in a byte.
struct Told {
  uint8_t light_points : 2;  // Node::light_points
  uint8_t new_points : 2;    // points that no leaf before it names
  uint8_t are_own : 1;       // these belong to it alone
};

std::vector<Told> own_part(const State& state, const Exchange& exchange) {
  std::vector<Told> told(state.forest.nodes.size());
  int32_t known = 0;  // an owner's points have numbers in the same order
  for (size_t k = 0; k < told.size(); ++k) {
    const Node& node = state.forest.nodes[k];
    if (!exchange.mine(state.forest, static_cast<NodeId>(k))) continue;
    told[k].light_points = node.light_points & 3;
    if (k >= state.direct.of_leaf.size() || state.direct.of_leaf[k][0] < 0) continue;
    for (int32_t point : state.direct.of_leaf[k])
      if (point == known) {
        ++known;
        told[k].new_points = (told[k].new_points + 1) & 3;
      }
    told[k].are_own = state.direct.of_leaf.own_places(k) != nullptr;
  }
  return told;
}

}  // namespace

size_t Places::own(int64_t place) const {
  if (owner_.empty()) return static_cast<size_t>(place);
  return static_cast<size_t>(std::lower_bound(own_.begin(), own_.end(), place) - own_.begin());
}

AllPoints::AllPoints(State& state, const Exchange& exchange) {
  if (exchange.alone()) {
    points_ = Places(state.direct.point_count());
    own_points_ = Places(3 * state.direct.of_leaf.own_count());
    return;
  }
  std::vector<Told> told = own_part(state, exchange);
  exchange.share(
      told, [&](size_t k) { return Exchange::surface_of(state.forest, static_cast<NodeId>(k)); });
  for (size_t k = 0; k < told.size(); ++k) {
    NodeArray& nodes = state.forest.nodes;
    const int32_t owner =
        exchange.owner(Exchange::surface_of(state.forest, static_cast<NodeId>(k)));
    if (!Forest::is_cluster(nodes[k]))
      nodes.set_light_points(k, static_cast<LightPoints>(told[k].light_points));
    for (int count = 0; count < told[k].new_points; ++count) {
      points_.add(owner, exchange.is_me(owner));
      if (told[k].are_own) own_points_.add(owner, exchange.is_me(owner));
    }
  }
}

LeafPoints::Numbers AllPoints::of_leaf(const CornerLight& direct, int64_t leaf) const {
  LeafPoints::Numbers numbers = direct.of_leaf[static_cast<size_t>(leaf)];
  if (numbers[0] >= 0)
    for (int32_t& number : numbers)
      number = static_cast<int32_t>(points_.place(static_cast<size_t>(number)));
  return numbers;
}

}  // namespace hrad
