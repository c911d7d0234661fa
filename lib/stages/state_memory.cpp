// Sizes of the arrays of a solution. Floor 7 (stages).
#include "stages/state_memory.h"

namespace hrad {

int64_t bytes_of(const State& state) {
  size_t bytes =
      state.forest.nodes.capacity() * sizeof(Node) + static_cast<size_t>(state.links.bytes()) +
      (state.radiosity.capacity() + state.irradiance.capacity() + state.gathered.capacity()) *
          sizeof(float);
  const CornerLight& direct = state.direct;
  bytes += state.cells.capacity() * sizeof(NodeId) +
           direct.of_leaf.capacity() * sizeof direct.of_leaf[0] +
           direct.first.capacity() * sizeof direct.first[0] +
           direct.links.capacity() * sizeof(Link) + direct.place.capacity() * sizeof(Vec3);
  return static_cast<int64_t>(bytes);
}

void clear(State& state) {
  const int64_t before = bytes_of(state);
  state.forest = Forest(*state.forest.scene);
  state.links = LinkTable();
  state.cells = std::vector<NodeId>();
  state.direct = CornerLight();
  for (auto* light : {&state.radiosity, &state.irradiance, &state.gathered})
    *light = std::vector<float>();
  state.memory.take(bytes_of(state) - before, "");
}

}  // namespace hrad
