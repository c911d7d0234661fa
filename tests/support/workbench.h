// A scene with all that the stages need, for tests that look at one stage at a time, and trees of
// elements split by hand.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "links/link_sampler.h"
#include "machine/comm_self.h"
#include "scene/load.h"
#include "stages/gather.h"
#include "stages/linking.h"
#include "stages/refine.h"
#include "stages/state.h"
#include "stages/sweep.h"
#include "support/check.h"

namespace hrad_test {

// Gives a leaf four children.
inline void split_node(hrad::Forest& forest, hrad::NodeId id) {
  const auto first = static_cast<hrad::NodeId>(forest.nodes.size());
  forest.nodes.resize(forest.nodes.size() + 4);
  forest.nodes.adopt(id, first);
}

inline void set_exposed_shares(hrad::Forest& forest, const hrad::LinkSampler& measure) {
  for (size_t k = 0; k < forest.nodes.size(); ++k)
    forest.nodes.set_exposed(k, measure.exposed_share(forest.nodes[k]));
}

// Splits whatever `wanted` says, up to `level`.
template <class Wanted>
void split_where(hrad::Forest& forest, int level, Wanted&& wanted) {
  for (size_t k = 0; k < forest.nodes.size(); ++k) {
    const hrad::Node& node = forest.nodes[k];
    if (node.first_child < 0 && node.level < level && wanted(node))
      split_node(forest, static_cast<hrad::NodeId>(k));
  }
}

inline void split_all(hrad::Forest& forest, int level) {
  split_where(forest, level, [](const hrad::Node&) { return true; });
}

inline hrad::Scene builtin_scene(const std::string& name) {
  hrad::Scene scene;
  hrad::make_builtin_scene(scene, name);
  return scene;
}

struct Workbench {
  explicit Workbench(hrad::Scene s, int threads = 2)
      : scene(std::move(s)),
        team(threads),
        engine(hrad::make_visibility_engine(scene, "builtin", "auto", team)),
        exposure(scene, *engine),
        state(scene),
        exchange(comm, std::vector<int32_t>(state.forest.surfaces.size(), 0)) {}

  hrad::StageTools tools(const hrad::OracleSettings& oracle) {
    return {team, exchange, *engine, exposure, oracle, [](double) { return true; }};
  }

  hrad::LinkSampler sampler(double near_ratio = 0.4, uint64_t seed = 1) const {
    return {state.forest, *engine, exposure, seed, near_ratio};
  }

  // Arrays as long as the forest, B = E.
  void prepare() {
    state.links.resize(state.forest.nodes.size());
    hrad::reset_to_emission(state, team, exchange);
  }

  // The Linking Stage, with the exposed shares of the roots.
  void link(const hrad::OracleSettings& oracle) {
    const hrad::LinkSampler measure = sampler(oracle.near_ratio, oracle.seed);
    set_exposed_shares(state.forest, measure);
    prepare();
    CHECK(hrad::link_pairs(state, tools(oracle), hrad::expected_brightness(state)));
  }

  // The same by clusters.
  // Exposed shares and clusters; no links yet.
  void prepare_clusters(const hrad::OracleSettings& oracle) {
    const hrad::LinkSampler measure = sampler(oracle.near_ratio, oracle.seed);
    set_exposed_shares(state.forest, measure);
    hrad::add_clusters(state.forest);
    prepare();
  }

  void link_by_clusters(const hrad::OracleSettings& oracle) {
    prepare_clusters(oracle);
    CHECK(hrad::link_clusters(state, tools(oracle), hrad::expected_brightness(state)));
  }

  void sweep(int times) {
    for (int k = 0; k < times; ++k) {
      hrad::gather(state, team);
      hrad::push_pull(state, team, exchange);
    }
  }

  hrad::LightOfAll radiosity_of_all() { return {state, &hrad::State::radiosity, exchange, team}; }
  hrad::Brightness brightness() {
    return hrad::measure_brightness(state, radiosity_of_all(), team, exchange);
  }

  void refine(const hrad::OracleSettings& oracle) {
    const hrad::LightOfAll radiosity = radiosity_of_all();
    CHECK(hrad::refine_links(state, tools(oracle), brightness(), radiosity));
  }

  hrad::Scene scene;
  hrad::ThreadTeam team;
  std::unique_ptr<hrad::VisibilityEngine> engine;
  hrad::Exposure exposure;
  hrad::State state;
  hrad::CommSelf comm;
  hrad::Exchange exchange;
};

}  // namespace hrad_test
