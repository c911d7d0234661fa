// What is expected: of a leaf's irradiance that of the leaf before, of a divided element's the mean
// of its children, of radiosity B = E + rho H. Floor 8 (solver).
#include "solver/checkpoint_light.h"

#include <cmath>

namespace hrad {
namespace {

size_t at(const State& state, int64_t node, int band) {
  return static_cast<size_t>(node) * static_cast<size_t>(state.bands) + static_cast<size_t>(band);
}

// irradiance, here and below: of all nodes.
float mean_of_children(const State& state, const float* irradiance, const Node& node, int band) {
  double sum = 0, exposed = 0;
  for (NodeId child = node.first_child; child < node.first_child + 4; ++child) {
    const double share = state.forest.nodes[static_cast<size_t>(child)].exposed;
    sum += share * irradiance[at(state, child, band)];
    exposed += share;
  }
  return exposed > 0 ? static_cast<float>(sum / exposed) : 0.0f;
}

float radiosity_by_irradiance(const State& state, const float* irradiance, int64_t id, int band) {
  const Node& node = state.forest.nodes[static_cast<size_t>(id)];
  if (Forest::is_cluster(node)) return 0;
  const Scene& scene = *state.forest.scene;
  const int64_t patch = state.forest.surfaces[static_cast<size_t>(node.surface)].patch;
  const size_t k = at(state, patch, band);
  return static_cast<float>(scene.emission[k] +
                            scene.reflectance[k] * irradiance[at(state, id, band)]);
}

}  // namespace

void pack_light(const State& state, const LightOfAll& radiosity_of_all,
                const LightOfAll& irradiance_of_all, int64_t first, int64_t end,
                PackedBytes& bytes) {
  const float *const all = irradiance_of_all[0], *const all_radiosity = radiosity_of_all[0];
  std::vector<uint32_t> irradiance, radiosity, last(static_cast<size_t>(state.bands), 0);
  for (int64_t id = first; id < end; ++id) {
    const Node& node = state.forest.nodes[static_cast<size_t>(id)];
    for (int b = 0; b < state.bands; ++b) {
      const uint32_t value = bits_of(all[at(state, id, b)]);
      uint32_t expected = 0;
      if (state.divided_in_order(node)) {
        expected = bits_of(mean_of_children(state, all, node, b));
      } else if (!Forest::is_cluster(node)) {
        expected = last[static_cast<size_t>(b)];
        last[static_cast<size_t>(b)] = value;
      }
      irradiance.push_back(zigzag32(value - expected));
      radiosity.push_back(zigzag32(bits_of(all_radiosity[at(state, id, b)]) -
                                   bits_of(radiosity_by_irradiance(state, all, id, b))));
    }
  }
  bytes.planes(irradiance);
  bytes.planes(radiosity);
}

void LightReader::unpack(PackedReader& bytes, int64_t first, int64_t end) {
  const size_t count = static_cast<size_t>(end - first) * static_cast<size_t>(state_.bands);
  std::vector<uint32_t> changes, last(static_cast<size_t>(state_.bands), 0);
  bytes.planes(count, changes);
  size_t k = 0;
  for (int64_t id = first; id < end; ++id) {
    const Node& node = state_.forest.nodes[static_cast<size_t>(id)];
    for (int b = 0; b < state_.bands; ++b, ++k) {
      uint32_t value = from_zigzag32(changes[k]);
      // Of divided elements it is a difference still.
      if (node.first_child < 0 && !Forest::is_cluster(node))
        value = last[static_cast<size_t>(b)] += value;
      irradiance_.push_back(value);
    }
  }
  bytes.planes(count, changes);
  for (uint32_t change : changes) radiosity_.push_back(from_zigzag32(change));
}

void LightReader::finish(const FilePlace& place) {
  state_.places.resize(state_.forest.nodes.size());
  state_.resize_light();
  const auto check = [&](float value, const char* what, int64_t id) {
    if (!(value >= 0) || !std::isfinite(value))
      fail_format(place, "the %s of node %lld is %g: it must be finite and at least 0", what,
                  static_cast<long long>(id), static_cast<double>(value));
    return value;
  };
  const float* const all = state_.irradiance.data();
  // Children come after their parents.
  for (int64_t id = static_cast<int64_t>(state_.forest.nodes.size()) - 1; id >= 0; --id) {
    const Node& node = state_.forest.nodes[static_cast<size_t>(id)];
    for (int b = 0; b < state_.bands; ++b) {
      const size_t k = at(state_, id, b);
      const uint32_t expected =
          node.first_child >= 0 ? bits_of(mean_of_children(state_, all, node, b)) : 0;
      state_.irradiance[k] = check(float_of(irradiance_[k] + expected), "irradiance", id);
      state_.radiosity[k] =
          check(float_of(radiosity_[k] + bits_of(radiosity_by_irradiance(state_, all, id, b))),
                "radiosity", id);
    }
  }
}

}  // namespace hrad
