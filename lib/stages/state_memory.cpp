// Sizes of the arrays of a solution. Floor 7 (stages).
#include "stages/state_memory.h"

namespace hrad {

int64_t bytes_of(const State& state) {
  size_t bytes = state.forest.nodes.capacity() * sizeof(Node) +
                 state.links.capacity() * sizeof(LinkRun) +
                 (state.radiosity.capacity() + state.irradiance.capacity() +
                  state.gathered.capacity()) *
                     sizeof(float);
  for (const LinkRun& run : state.links) bytes += static_cast<size_t>(run.count()) * sizeof(Link);
  return static_cast<int64_t>(bytes);
}

}  // namespace hrad
