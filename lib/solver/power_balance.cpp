// The power balance. Floor 8 (solver).
#include <algorithm>

#include "base/draw.h"
#include "base/frame.h"
#include "base/hash.h"
#include "base/low_discrepancy.h"
#include "base/triangle_points.h"
#include "solver/measure.h"
#include "stages/exchange.h"

namespace hrad {
namespace {

Vec3 point_of(const Triangle& t, uint64_t hash) {
  double u = unit_interval(mix(hash, 1)), v = unit_interval(mix(hash, 2));
  fold_into_triangle(u, v);
  return t.at(u, v);
}

}  // namespace

std::optional<PowerBalance> measure_balance(State& state, const LightOfAll& radiosity,
                                            const StageTools& tools) {
  const Scene& scene = *state.forest.scene;
  const Forest& forest = state.forest;
  const int bands = state.bands;
  PowerBalance balance;
  for (auto* v : {&balance.emitted, &balance.absorbed, &balance.absorbed_back, &balance.escaped})
    v->assign(bands, 0.0);
  // Leaving power of the exposed part of every leaf, in relative units of its strongest band.
  std::optional<LightOfAll> irradiance(std::in_place, state, &State::irradiance, tools.exchange,
                                       tools.team);
  const std::vector<NodeId> leaves = forest.leaves();
  std::vector<double> leaving(bands, 0.0);
  for (NodeId id : leaves) {
    const Node& node = forest.nodes[id];
    const double area = forest.area(node), exposed = area * node.exposed;
    const size_t patch = static_cast<size_t>(forest.surfaces[node.surface].patch) * bands;
    for (int b = 0; b < bands; ++b) {
      balance.emitted[b] += area * scene.emission[patch + b];
      balance.absorbed[b] += exposed * (1 - scene.reflectance[patch + b]) * (*irradiance)[id][b];
      // What a sealed part emits is absorbed in the contact.
      balance.absorbed_back[b] += (area - exposed) * scene.emission[patch + b];
      leaving[b] += exposed * radiosity[id][b];
    }
  }
  irradiance.reset();  // rays ask for radiosity alone
  std::vector<double> weights(leaves.size(), 0.0);
  for (size_t k = 0; k < leaves.size(); ++k) {
    const Node& node = forest.nodes[leaves[k]];
    const double exposed = forest.area(node) * node.exposed;
    for (int b = 0; b < bands; ++b)
      if (leaving[b] > 0) weights[k] += exposed * radiosity[leaves[k]][b] / leaving[b];
  }
  const Draw draw(weights);
  if (!(draw.total() > 0)) return balance;

  // A fixed number of tasks, each with sums of its own, added in order.
  constexpr int64_t tasks = 64;
  struct Sums {
    double back[most_bands] = {}, out[most_bands] = {};
    int64_t back_rays = 0, rays = 0;
  };
  std::vector<Sums> sums(tasks);
  constexpr int64_t rays_of_a_task = rays_of_the_balance / tasks;
  // Leaves take their turns in order, so that the rays of each are a part of the sequence, spread
  // evenly over it and its hemisphere.
  const LowDiscrepancy sequence(mix(tools.oracle.seed, 0x706f776572u));
  const auto trace = [&](int64_t task, int) {
    if (!tools.exchange.my_turn(task)) return;
    Sums& s = sums[task];
    for (int64_t k = 0; k < rays_of_a_task; ++k) {
      const int64_t number = task * rays_of_a_task + k;
      const uint64_t h = mix(tools.oracle.seed, static_cast<uint64_t>(number), 0x706f776572u);
      double p[4], u, v;
      sequence.point(static_cast<uint32_t>(number), p);
      even_in_triangle(p[0], p[1], &u, &v);
      const double fraction = (static_cast<double>(number) + unit_interval(h)) /
                              static_cast<double>(rays_of_the_balance);
      const size_t pick = draw.pick(fraction);
      const NodeId id = leaves[pick];
      const Node& node = forest.nodes[id];
      const Surface& surface = forest.surfaces[node.surface];
      const Triangle triangle = forest.triangle(node);
      Vec3 on = triangle.at(u, v);
      // On a partly sealed leaf only exposed points send light.
      if (node.exposed < 1)
        for (uint64_t again = 1;
             again < 64 && tools.exposure.sealed(surface.patch, surface.side, on); ++again)
          on = point_of(triangle, mix(h, again));
      const Frame frame(surface.normal);
      const Vec3 d = frame.cosine_direction(p[2], p[3]);
      const Hit hit = tools.engine.nearest(on + surface.normal * tools.engine.offset(), d, 0);
      ++s.rays;
      const bool lost = hit.patch < 0;
      const int32_t side = hit.back ? 1 : 0;
      if (!lost && forest.root(hit.patch, side) >= 0) {
        // Where the back of something lies flat on this side, it is that back which is met.
        const Vec3 at = scene.triangle(hit.patch).at(hit.u, hit.v);
        if (!tools.exposure.under_a_back(hit.patch, side, at)) continue;
      }
      if (!lost) ++s.back_rays;
      const double chance = weights[pick] / draw.total();
      const double exposed = forest.area(node) * node.exposed;
      for (int b = 0; b < bands; ++b) {
        const double power =
            exposed * radiosity[id][b] / (chance * static_cast<double>(rays_of_the_balance));
        (lost ? s.out : s.back)[b] += power;
      }
    }
  };
  const bool going_on = tools.team.for_each(tasks, trace, [&](int64_t done) {
    return tools.progress(static_cast<double>(done) / tasks);
  });
  if (!tools.exchange.all_go_on(going_on)) return std::nullopt;
  for (const Sums& s : sums) balance.rays += s.rays;
  tools.exchange.share_turns(sums, tools.team);
  int64_t rays = 0, back_rays = 0;
  for (const Sums& s : sums) {
    rays += s.rays;
    back_rays += s.back_rays;
    for (int b = 0; b < bands; ++b) {
      balance.absorbed_back[b] += s.back[b];
      balance.escaped[b] += s.out[b];
    }
  }
  balance.back_share = static_cast<double>(back_rays) / static_cast<double>(rays);
  return balance;
}

}  // namespace hrad
