// Shadow rays and cosine rays from a point. Floor 8 (solver).
#include "solver/ray_gather.h"

#include <algorithm>
#include <cmath>

#include "base/frame.h"
#include "base/hash.h"

namespace hrad {
namespace {

constexpr int most_bands = 16;

double largest_emission(const Scene& scene, int32_t patch) {
  const size_t at = static_cast<size_t>(patch) * scene.bands;
  return *std::max_element(scene.emission.begin() + static_cast<std::ptrdiff_t>(at),
                           scene.emission.begin() + static_cast<std::ptrdiff_t>(at) + scene.bands);
}

// Uniform in a triangle from the unit square, folded along the diagonal.
void fold(double& u, double& v) {
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
}

// The bits of k mirrored at the binary point: 0, 1/2, 1/4, 3/4, 1/8 ...
double reversed_bits(uint32_t k) {
  double value = 0, place = 0.5;
  for (; k; k >>= 1, place /= 2) value += (k & 1) * place;
  return value;
}

}  // namespace

RayGather::RayGather(const State& state, const VisibilityEngine& engine)
    : state_(state), engine_(engine) {
  const Scene& scene = *state.forest.scene;
  double total = 0;
  for (NodeId root = 0; root < state.forest.surface_count(); ++root) {
    const Surface& surface = state.forest.surfaces[root];
    const double power = surface.area * largest_emission(scene, surface.patch);
    if (!(power > 0)) continue;
    total += power;
    emitters_.push_back(root);
    cumulative_.push_back(total);
  }
  for (double& c : cumulative_) c /= total;
  chance_.assign(static_cast<size_t>(state.forest.surface_count()), 0.0);
  for (size_t k = 0; k < emitters_.size(); ++k)
    chance_[emitters_[k]] = cumulative_[k] - (k ? cumulative_[k - 1] : 0.0);
}

// Emission that arrives from a point of an emitter at distance d may be found by a cosine ray and by
// a shadow ray; both together count it once, and neither makes large values where the emitter is
// near: the balance heuristic (Veach and Guibas, SIGGRAPH '95). This is what a sample of either kind
// is worth, as irradiance per emission.
double RayGather::share(NodeId emitter, double distance2, double at_x, double at_y) const {
  const double cosine = at_x / pi;
  const double by_area =
      chance_[emitter] * distance2 / (state_.forest.surfaces[emitter].area * at_y);
  return cosine / (by_area + cosine);
}

int64_t RayGather::sample(Vec3 x, Vec3 n, uint64_t key, int rays, double* sum,
                          double* squares) const {
  const Scene& scene = *state_.forest.scene;
  const Forest& forest = state_.forest;
  const int bands = state_.bands;
  const Frame frame(n);
  const double turn = unit_interval(mix(key, 0x7475726eu));
  int64_t traced = 0;
  for (int k = 0; k < rays; ++k) {
    const uint64_t h = mix(key, static_cast<uint64_t>(k));
    double value[most_bands] = {};
    // Directions from a Hammersley set, jittered in one coordinate and turned in the other.
    const double u = (k + unit_interval(mix(h, 1))) / rays;
    const double v = reversed_bits(static_cast<uint32_t>(k)) + turn;
    const Vec3 direction = frame.cosine_direction(std::min(u, 1 - 1e-12), v < 1 ? v : v - 1);
    const Hit hit = engine_.nearest(x, direction, 0);
    ++traced;
    if (hit.patch >= 0) {
      const int32_t side = hit.back ? 1 : 0;
      const NodeId root = forest.root(hit.patch, side);
      if (root >= 0) {
        const NodeId leaf = side ? forest.leaf_at(root, hit.v, hit.u)
                                 : forest.leaf_at(root, hit.u, hit.v);
        // Sealed or not, the emitted part is the patch's own and even.
        const double emitted =
            chance_[root] > 0 ? share(root, hit.t * hit.t, dot(direction, n),
                                      std::fabs(dot(direction, forest.surfaces[root].normal)))
                              : 0.0;
        for (int b = 0; b < bands; ++b) {
          const double emission = scene.emission[static_cast<size_t>(hit.patch) * bands + b];
          value[b] += state_.radiosity[static_cast<size_t>(leaf) * bands + b] - emission +
                      emitted * emission;
        }
      }
    }
    if (!emitters_.empty()) {
      const double pick = (k + unit_interval(mix(h, 3))) / rays;
      const size_t e = static_cast<size_t>(
          std::min<std::ptrdiff_t>(std::upper_bound(cumulative_.begin(), cumulative_.end(), pick) -
                                       cumulative_.begin(),
                                   static_cast<std::ptrdiff_t>(cumulative_.size()) - 1));
      const Surface& emitter = forest.surfaces[emitters_[e]];
      double su = unit_interval(mix(h, 4)), sv = unit_interval(mix(h, 5));
      fold(su, sv);
      const Vec3 y = forest.root_triangle(emitters_[e]).at(su, sv) +
                     emitter.normal * engine_.offset();
      const Vec3 d = y - x;
      const double d2 = dot(d, d), at_x = dot(d, n), at_y = -dot(d, emitter.normal);
      if (at_x > 0 && at_y > 0 && d2 > 0) {
        const Hit first = engine_.nearest(x, d, 0);
        ++traced;
        if (first.patch < 0 || first.t >= 1) {
          const double distance = std::sqrt(d2);
          const double worth = share(emitters_[e], d2, at_x / distance, at_y / distance);
          for (int b = 0; b < bands; ++b)
            value[b] += worth * scene.emission[static_cast<size_t>(emitter.patch) * bands + b];
        }
      }
    }
    for (int b = 0; b < bands; ++b) {
      sum[b] += value[b];
      squares[b] += value[b] * value[b];
    }
  }
  return traced;
}

}  // namespace hrad
