// The error estimate. Floor 8 (solver).
#include "solver/measure.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "base/low_discrepancy.h"
#include "base/triangle_points.h"
#include "links/element.h"
#include "solver/ray_gather.h"
#include "stages/exchange.h"

namespace hrad {
namespace {

// Patches are drawn batch by batch until the error is known to this share of itself, or is
// known to be far below the accuracy.
constexpr size_t patches_of_a_batch = 512;
constexpr int most_batches = 4;
constexpr double precise_share = 0.35, precise_enough = 0.2;
// Of a batch, each spread over all patches: after every one something is known.
constexpr size_t parts_of_a_batch = 4;
// Of each half of a patch; a point has one packet of shadow rays besides.
constexpr int cosine_rays_of_a_point = 4;
constexpr double points_at_one_percent = 64, least_points = 16, most_points = 256;

int points_of_a_half(double accuracy) {
  return static_cast<int>(
      std::max(least_points, std::min(most_points, points_at_one_percent * 0.01 / accuracy)));
}

// Until it is known better. Small errors are hard to tell from noise.
double expected_batches(double accuracy) {
  constexpr double accuracy_of_one = 0.025;
  return std::max(1.0, std::min<double>(most_batches, accuracy_of_one / accuracy));
}

bool take_residual(KnownResult& known, Residual& residual) {
  Residual r;
  if (!known.take(&r, 1) || !known.at_end() || !is_count(r.rays)) return false;
  for (double value : r.difference)
    if (!std::isfinite(value)) return false;
  for (double value : {r.squares, r.solved, r.solved_sum})
    if (!std::isfinite(value)) return false;
  residual = r;
  return true;
}

Residual residual_of(const State& state, const StageTools& tools, const RayGather& rays,
                     RayGather::NearEmitters& space, NodeId root, uint64_t key, int points,
                     bool reflected) {
  const Scene& scene = *state.forest.scene;
  const Surface& surface = state.forest.surfaces[root];
  const int bands = state.bands;
  const Element element = element_of(state.forest, state.forest.nodes[root]);
  const Draw& emitters = rays.emitters_near(element, space);
  double sum[2][most_bands] = {};
  Residual r;
  for (uint64_t half = 0; half < 2; ++half)
    for (uint32_t k = 0; k < static_cast<uint32_t>(points); ++k) {
      double p[4], value[most_bands], u, v;
      low_discrepancy_point(mix(key, half, 1), k, p);
      even_in_triangle(p[0], p[1], &u, &v);
      const Vec3 on = element.corners.at(u, v);
      if (tools.exposure.sealed(surface.patch, surface.side, on)) continue;
      r.rays += rays.sample(on + surface.normal * tools.engine.offset(), surface.normal,
                            mix(key, half, 2), k, cosine_rays_of_a_point, emitters, value);
      for (int b = 0; b < bands; ++b) sum[half][b] += value[b];
    }
  const double exposed = state.forest.nodes[root].exposed;
  for (int b = 0; b < bands; ++b) {
    const size_t at = static_cast<size_t>(surface.patch) * bands + b;
    const double factor = reflected ? scene.reflectance[at] : 1.0;
    const double solved = factor * exposed * state.irradiance_of(root)[b];
    for (const auto& of_half : sum) {
      const double difference = solved - factor * of_half[b] / points;
      r.difference[b] += difference;
      r.squares += difference * difference;
    }
    r.solved += solved * solved;
    r.solved_sum += solved;
  }
  return r;
}

// The patches that can be drawn: those that emit nothing, by area and by the light on them, where
// errors are larger; in a scene that reflects nothing, by irradiance.
struct Patches {
  std::vector<NodeId> roots;
  std::vector<double> areas, weights;
  bool reflected = false;
  double returned = 0;  // share of the power leaving all surfaces that is reflected light
  explicit Patches(const State& state);
};

Patches::Patches(const State& state) {
  const Scene& scene = *state.forest.scene;
  const Forest& forest = state.forest;
  const size_t bands = static_cast<size_t>(state.bands);
  std::vector<double> emitted(bands, 0.0), sent_back(bands, 0.0);
  for (NodeId root = 0; root < forest.surface_count(); ++root) {
    const Surface& surface = forest.surfaces[root];
    const double* reflectance = &scene.reflectance[static_cast<size_t>(surface.patch) * bands];
    const double largest = *std::max_element(reflectance, reflectance + bands);
    for (size_t b = 0; b < bands; ++b) {
      emitted[b] += surface.area * scene.emission[static_cast<size_t>(surface.patch) * bands + b];
      sent_back[b] +=
          surface.area * forest.nodes[root].exposed * reflectance[b] * state.irradiance_of(root)[b];
    }
    if (scene.emits(surface.patch)) continue;
    reflected = reflected || largest > 0;
    roots.push_back(root);
    areas.push_back(surface.area);
  }
  for (size_t b = 0; b < bands; ++b)
    if (sent_back[b] > 0)
      returned = std::max(returned, std::min(0.99, sent_back[b] / (emitted[b] + sent_back[b])));
  double squares = 0, dark_area = 0;
  std::vector<double> square;
  for (size_t k = 0; k < roots.size(); ++k) {
    const size_t patch = static_cast<size_t>(forest.surfaces[roots[k]].patch) * bands;
    double sum = 0;
    for (size_t b = 0; b < bands; ++b) {
      const double light = (reflected ? scene.reflectance[patch + b] : 1.0) *
                           forest.nodes[roots[k]].exposed * state.irradiance_of(roots[k])[b];
      sum += light * light;
    }
    square.push_back(sum);
    squares += areas[k] * sum;
    dark_area += areas[k];
  }
  for (size_t k = 0; k < roots.size(); ++k)
    weights.push_back(areas[k] * (squares > 0 ? square[k] * dark_area / squares + 1 : 1));
}

// Residuals of patches that are drawn batch by batch.
class Measurement {
 public:
  // All must outlive this.
  Measurement(State& state, const LightOfAll& radiosity, const StageTools& tools,
              const Patches& patches, int points)
      : state_(state),
        tools_(tools),
        patches_(patches),
        points_(points),
        draw_(patches.weights),
        rays_(state, radiosity, tools.engine, RayGather::Solution::doubted),
        spaces_(static_cast<size_t>(tools.team.size())) {}

  void draw_batch() {
    const size_t first = drawn_.size();
    for (size_t k = 0; k < patches_of_a_batch; ++k) {
      const double step = static_cast<double>(k) + unit_interval(key_of(first + k));
      const size_t patch = draw_.pick(step / patches_of_a_batch);
      drawn_.push_back({patch, patches_.areas[patch] / patches_.weights[patch]});
    }
    residuals_.resize(drawn_.size());
  }

  // A part of the last batch. progress: told how much of it is done. False: stopped.
  bool measure(size_t part, const std::function<bool(double)>& progress) {
    const size_t first = drawn_.size() - patches_of_a_batch;
    std::vector<Residual> measured(patches_of_a_batch / parts_of_a_batch);
    std::vector<size_t> own;
    for (size_t k = 0; k < measured.size(); ++k)
      if (tools_.exchange.my_turn(static_cast<int64_t>(k))) own.push_back(k);
    const auto residual = [&](size_t task) -> Residual& { return measured[own[task]]; };
    const auto measure_one = [&](size_t task, int worker) {
      const size_t number = first + place_of(part, own[task]);
      residual(task) = residual_of(state_, tools_, rays_, spaces_[static_cast<size_t>(worker)],
                                   patches_.roots[drawn_[number].number], key_of(number), points_,
                                   patches_.reflected);
    };
    const double tasks = static_cast<double>(std::max<size_t>(1, own.size()));
    const bool going_on = state_.journal.next_pass_of(
        tools_.team, own.size(),
        {[&](size_t task) { return static_cast<uint64_t>(place_of(part, own[task])); },
         [&](size_t task, KnownResult& known) { return take_residual(known, residual(task)); },
         measure_one, [&](size_t task, Bytes& bytes) { put(bytes, &residual(task), 1); }},
        [&](int64_t done) { return progress(static_cast<double>(done) / tasks); });
    if (!tools_.exchange.all_go_on(going_on)) return false;
    for (const Residual& r : measured) rays_sent_ += r.rays;
    tools_.exchange.share_turns(measured, tools_.team);
    for (size_t k = 0; k < measured.size(); ++k)
      residuals_[first + place_of(part, k)] = measured[k];
    return true;
  }

  MeasuredError error() const { return error_of(drawn_, residuals_, patches_.returned); }
  // By the first parts of the first batch, all there is.
  MeasuredError error_of_parts(size_t parts) const {
    std::vector<DrawnPatch> drawn;
    std::vector<Residual> residuals;
    for (size_t k = 0; k < drawn_.size(); ++k) {
      if (k % parts_of_a_batch >= parts) continue;
      drawn.push_back(drawn_[k]);
      residuals.push_back(residuals_[k]);
    }
    return error_of(drawn, residuals, patches_.returned);
  }
  int64_t rays_sent() const { return rays_sent_; }

 private:
  // In a batch, of patch k of a part.
  static size_t place_of(size_t part, size_t k) { return part + parts_of_a_batch * k; }
  uint64_t key_of(size_t number) const { return mix(tools_.oracle.seed, number, 0x6572726f72u); }

  State& state_;
  const StageTools& tools_;
  const Patches& patches_;
  const int points_;
  const Draw draw_;
  const RayGather rays_;
  std::vector<RayGather::NearEmitters> spaces_;
  std::vector<Residual> residuals_;
  std::vector<DrawnPatch> drawn_;
  int64_t rays_sent_ = 0;  // by this process
};

}  // namespace

double expected_rays_of_estimate(double accuracy) {
  // A packet of shadow rays takes as long as about a quarter so many that go alone.
  constexpr double rays_of_a_point = cosine_rays_of_a_point + RayGather::shadow_rays / 4.0;
  return expected_batches(accuracy) * patches_of_a_batch * 2 * points_of_a_half(accuracy) *
         rays_of_a_point;
}

std::optional<ErrorEstimate> estimate_error(
    State& state, const LightOfAll& radiosity, const StageTools& tools, double accuracy,
    const std::function<void(const MeasuredError&)>& so_far) {
  ErrorEstimate estimate;
  const Patches patches(state);
  if (patches.roots.empty()) return estimate;
  Measurement measurement(state, radiosity, tools, patches, points_of_a_half(accuracy));
  double batches = expected_batches(accuracy);
  for (int batch = 0; batch < most_batches; ++batch) {
    measurement.draw_batch();
    for (size_t part = 0; part < parts_of_a_batch; ++part) {
      const auto progress = [&](double share) {
        const double parts = static_cast<double>(part) + share;
        return tools.progress((batch + parts / parts_of_a_batch) / batches);
      };
      if (!measurement.measure(part, progress)) return std::nullopt;
      if (so_far && batch == 0 && part + 1 < parts_of_a_batch)
        so_far(measurement.error_of_parts(part + 1));
    }
    static_cast<MeasuredError&>(estimate) = measurement.error();
    if (so_far) so_far(estimate);
    const double wanted = std::max(precise_share * estimate.error, precise_enough * accuracy);
    if (estimate.standard_error < wanted) break;
    const double short_by = estimate.standard_error / wanted;
    batches = std::max(
        batches,
        std::min<double>(most_batches, std::max(batch + 2.0, (batch + 1) * short_by * short_by)));
  }
  estimate.rays = measurement.rays_sent();
  return estimate;
}

}  // namespace hrad
