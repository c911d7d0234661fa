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

template <class Body>
void for_each_run(int64_t count, ThreadTeam& team, const Body& body) {
  team.for_each((count + nodes_of_a_task - 1) / nodes_of_a_task, [&](int64_t task, int) {
    const int64_t end = std::min(count, (task + 1) * nodes_of_a_task);
    for (int64_t k = task * nodes_of_a_task; k < end; ++k) body(static_cast<size_t>(k));
  });
}

void gather_run(Span<const Link> links, const State& state, float* out) {
  if (state.bands == 3)
    gather_run<3>(links, state.radiosity.data(), 3, out);
  else if (state.bands == 1)
    gather_run<1>(links, state.radiosity.data(), 1, out);
  else
    gather_run<0>(links, state.radiosity.data(), state.bands, out);
}

}  // namespace

void gather_corner(const State& state, size_t corner, float* irradiance) {
  const CornerLight& direct = state.direct;
  gather_run({direct.links.data() + direct.first[corner],
              static_cast<size_t>(direct.first[corner + 1] - direct.first[corner])},
             state, irradiance);
}

void gather(State& state, ThreadTeam& team) {
  const size_t bands = static_cast<size_t>(state.bands);
  const size_t corners = state.direct.corner_count();
  std::vector<float> at_corners(corners * bands);
  for_each_run(static_cast<int64_t>(corners), team,
               [&](size_t k) { gather_corner(state, k, &at_corners[k * bands]); });
  for_each_run(static_cast<int64_t>(state.forest.nodes.size()), team, [&](size_t k) {
    gather_run(state.links[k].links(), state, &state.gathered[k * bands]);
    // Light is linear between the corners of a leaf: its mean is theirs.
    for (int b = 0; b < state.bands && corners > 0; ++b)
      state.gathered[k * bands + b] += static_cast<float>(
          mean_of_corners(state.direct, at_corners, static_cast<NodeId>(k), b, state.bands));
  });
}

}  // namespace hrad
