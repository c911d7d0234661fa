// The sparse product, node by node. Floor 7 (stages).
#include "stages/gather.h"

#include <algorithm>

namespace hrad {
namespace {

constexpr int64_t nodes_of_a_task = 2048;
constexpr int most_bands = 16;

// Bands: their number where it is known at compile time, 0 otherwise.
template <int Bands>
void gather_run(Span<const Link> links, const float* radiosity, int bands_at_run_time,
                float* gathered) {
  const int bands = Bands ? Bands : bands_at_run_time;
  double sum[Bands ? Bands : most_bands] = {};
  for (const Link& link : links) {
    const float* source = radiosity + static_cast<size_t>(link.source) * bands;
    for (int band = 0; band < bands; ++band)
      sum[band] += static_cast<double>(link.weight) * source[band];
  }
  for (int band = 0; band < bands; ++band) gathered[band] = static_cast<float>(sum[band]);
}

}  // namespace

void gather(State& state, ThreadTeam& team) {
  const int64_t nodes = static_cast<int64_t>(state.forest.nodes.size());
  const int bands = state.bands;
  team.for_each((nodes + nodes_of_a_task - 1) / nodes_of_a_task, [&](int64_t task, int) {
    const int64_t end = std::min(nodes, (task + 1) * nodes_of_a_task);
    for (int64_t k = task * nodes_of_a_task; k < end; ++k) {
      const Span<const Link> links = state.links[k].links();
      float* out = &state.gathered[static_cast<size_t>(k) * bands];
      if (bands == 3)
        gather_run<3>(links, state.radiosity.data(), bands, out);
      else if (bands == 1)
        gather_run<1>(links, state.radiosity.data(), bands, out);
      else
        gather_run<0>(links, state.radiosity.data(), bands, out);
    }
  });
}

}  // namespace hrad
