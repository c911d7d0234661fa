// Owners tell of their elements; clusters are known. Floor 7 (stages).
#include "stages/light_of_all.h"

#include <algorithm>
#include <cstring>

namespace hrad {

LightOfAll::LightOfAll(State& state, GrowingArray<float> State::*quantity, const Exchange& exchange,
                       ThreadTeam& team)
    : bands_(static_cast<size_t>(state.bands)), memory_(state), values_(&(state.*quantity)) {
  if (exchange.alone()) return;
  const Forest& forest = state.forest;
  const GrowingArray<float>& known = state.*quantity;
  const size_t nodes = forest.nodes.size(), values = nodes * bands_;
  const int64_t all_bytes = static_cast<int64_t>(values * sizeof(float));
  memory_.take(2 * all_bytes, "light of all elements");  // as messages, too
  told_.reserve(values);
  told_.resize_for_overwrite(values);
  const size_t roots = exchange.owners().size(), first = forest.nodes.first_element();
  std::copy_n(known.begin(), first * bands_, told_.begin());  // for the sake of clusters
  const auto node_of = [&](size_t k) { return k < roots ? k : k + first - roots; };
  const size_t bytes = bands_ * sizeof(float);
  share_rows(
      exchange.comm(), team, nodes - (first - roots), bytes,
      [&](size_t k) { return exchange.owner(forest.nodes[node_of(k)].surface); },
      [&](size_t k, char* to) {
        const float* own = &known[state.values_before(static_cast<NodeId>(node_of(k)))];
        std::copy_n(own, bands_, &told_[node_of(k) * bands_]);
        std::memcpy(to, own, bytes);
      },
      [&](size_t k, const char* from) { std::memcpy(&told_[node_of(k) * bands_], from, bytes); });
  memory_.take(-all_bytes, "");
  values_ = &told_;
}

}  // namespace hrad
