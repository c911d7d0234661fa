// Sizes of the arrays of a solution. Floor 7 (stages).
#include "stages/state_memory.h"

namespace hrad {

int64_t bytes_of_links(const State& state) {
  return state.links.bytes_of_links() + state.direct.mean.bytes_of_links() +
         bytes_in(state.direct.links);
}

int64_t bytes_of_nodes(const State& state) {
  const CornerLight& direct = state.direct;
  const ClusterTree& tree = state.forest.clusters;
  return bytes_in(tree.clusters) + bytes_in(tree.order) + bytes_in(tree.area_before) +
         state.forest.nodes.bytes() + bytes_in(state.radiosity) + bytes_in(state.irradiance) +
         state.places.bytes() + state.links.bytes() - state.links.bytes_of_links() +
         bytes_in(state.cells) + direct.mean.bytes() - direct.mean.bytes_of_links() +
         direct.of_leaf.bytes() + bytes_in(direct.first) + state.journal.bytes();
}

int64_t bytes_of(const State& state) { return bytes_of_nodes(state) + bytes_of_links(state); }

void shrink_to_fit(State& state) {
  state.forest.nodes.shrink_to_fit();
  state.radiosity.shrink_to_fit();
  state.irradiance.shrink_to_fit();
  state.places.shrink_to_fit();
  state.cells.shrink_to_fit();
  state.links.shrink_to_fit();
  state.direct.mean.shrink_to_fit();
  state.direct.of_leaf.shrink_to_fit();
  state.direct.first.shrink_to_fit();
  state.direct.links.shrink_to_fit();
}

void clear(State& state) {
  counted(state, [&] {
    state.forest = Forest(*state.forest.scene);
    state.links = LinkTable();
    state.cells = std::vector<NodeId>();
    state.direct = CornerLight();
    state.places = LightPlaces();
    for (auto* light : {&state.radiosity, &state.irradiance}) *light = GrowingArray<float>();
  });
}

}  // namespace hrad
