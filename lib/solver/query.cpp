// Answers from a solution: patches, points, leaves, balance. Floor 8 (solver).
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "solver/schedule.h"
#include "solver/solution.h"

namespace hrad {
namespace {

// From the irradiance over the whole area: radiosity there is B = E + rho H.
double value_of(Quantity quantity, double emission, double reflectance, double irradiance) {
  switch (quantity) {
    case Quantity::radiosity:
      return emission + reflectance * irradiance;
    case Quantity::irradiance:
      return irradiance;
    case Quantity::emission:
      return emission;
    default:
      return emission + reflectance * irradiance - irradiance;
  }
}

// Mean over the whole area of a node, sealed parts included.
void node_values(const State& state, NodeId id, const float* irradiance_of_node, Quantity quantity,
                 double* out) {
  const Scene& scene = *state.forest.scene;
  const Node& node = state.forest.nodes[id];
  const size_t patch = static_cast<size_t>(state.forest.surfaces[node.surface].patch) * state.bands;
  for (int b = 0; b < state.bands; ++b) {
    const double irradiance = node.exposed * irradiance_of_node[b];
    out[b] =
        value_of(quantity, scene.emission[patch + b], scene.reflectance[patch + b], irradiance);
  }
}

}  // namespace

const std::vector<NodeId>& Solver::leaves() const {
  std::vector<NodeId>& leaves = solution_->answers.leaves;
  if (leaves.empty()) leaves = solution_->state.forest.leaves();
  return leaves;
}

// All of them have it, or none.
const LightOfAll& Solver::Solution::light_of_all(std::unique_ptr<LightOfAll>& answer,
                                                 GrowingArray<float> State::*quantity) {
  if (!answer) {
    auto made = std::make_unique<LightOfAll>(state, quantity, *exchange, *team);
    exchange->comm().all_go_on();
    answer = std::move(made);
  }
  return *answer;
}

const LightOfAll& Solver::radiosity_of_all() const {
  return solution_->light_of_all(solution_->answers.radiosity, &State::radiosity);
}

const LightOfAll& Solver::irradiance_of_all() const {
  return solution_->light_of_all(solution_->answers.irradiance, &State::irradiance);
}

void Solver::prepare_leaves() const { irradiance_of_all(); }

const Reconstruction& Solver::reconstruction() const {
  Solution& s = *solution_;
  if (!s.answers.reconstruction) {
    const RowSettings rows = rows_of(params_, s.state.forest, s.inspection.mean_distance, s.scale);
    auto made =
        std::make_unique<Reconstruction>(s.state, leaves(), *s.exchange, *s.team, rows.cell_area);
    comm_->all_go_on();
    s.answers.reconstruction = std::move(made);
  }
  return *s.answers.reconstruction;
}

bool Solver::Solution::measure(const StageTools& tools, double accuracy, Stats& stats,
                               const std::function<void(const MeasuredError&)>& so_far) {
  const double all = expected_rays_of_estimate(accuracy) + rays_of_the_balance;
  const double of_balance = rays_of_the_balance / all;
  const LightOfAll radiosity(state, &State::radiosity, tools.exchange, tools.team);
  const std::optional<ErrorEstimate> estimate =
      estimate_error(state, radiosity, tools.of_part(0, 1 - of_balance), accuracy, so_far);
  if (!estimate) return false;
  std::optional<PowerBalance> measured =
      measure_balance(state, radiosity, tools.of_part(1 - of_balance, 1));
  if (!measured) return false;
  stats.error_estimate = estimate->error;
  stats.error_standard_error = estimate->standard_error;
  balance = *std::move(measured);
  state.rays += estimate->rays + balance.rays;
  finished = true;
  measuring_due = false;
  return true;
}

void Solver::measure_if_due() const {
  if (!solution_ || !solution_->measuring_due) return;
  // The light that was solved for is gone from the scene, and can't be measured any more.
  if (hash_of_light(scene_) != solution_->light_hash) return;
  Solution& s = *solution_;
  s.measure({*s.team, *s.exchange, *s.engine, *s.exposure,
             oracle_of_round(params_, s.state, first_rounds, s.scale), [](double) { return true; }},
            params_.accuracy, stats_);
}

bool Solver::solved() const { return solution_ && solution_->linked; }

void Solver::require_solved() const {
  if (!solved()) fail(Status::state, "there is no solution yet: call hrad_solve first");
}

void Solver::query_patches(Quantity quantity, int32_t side, int64_t first, int64_t count,
                           double* out) const {
  if (quantity != Quantity::emission) require_solved();
  comm_->all_go_on();  // nothing is answered to anyone unless all ask for what there is
  const int bands = scene_.bands;
  if (quantity == Quantity::emission) {
    for (int64_t k = 0; k < count; ++k) {
      const int64_t patch = first + k;
      const bool emits = !scene_.has(patch, patch_dropped) && !scene_.has(patch, patch_blocker) &&
                         (side == 0 || scene_.has(patch, patch_two_sided));
      for (int b = 0; b < bands; ++b)
        out[k * bands + b] = emits ? scene_.emission[static_cast<size_t>(patch) * bands + b] : 0;
    }
    return;
  }
  const State& state = solution_->state;
  for (int64_t k = 0; k < count; ++k) {
    const NodeId root = state.forest.root(first + k, side);
    if (root >= 0)
      node_values(state, root, state.irradiance_of(root), quantity, out + k * bands);
    else
      std::fill(out + k * bands, out + (k + 1) * bands, 0.0);
  }
}

void Solver::query_points(Quantity quantity, int32_t side, int64_t count, const int64_t* patch,
                          const double* uv, double* out) const {
  require_solved();
  const State& state = solution_->state;
  const int bands = scene_.bands;
  comm_->all_go_on();
  const Reconstruction& linear = reconstruction();
  for (int64_t k = 0; k < count; ++k) {
    const NodeId root = state.forest.root(patch[k], side);
    double* values = out + k * bands;
    if (root < 0) {
      std::fill(values, values + bands, 0.0);
      continue;
    }
    double u = std::max(0.0, uv[2 * k]), v = std::max(0.0, uv[2 * k + 1]);
    if (side == 1) std::swap(u, v);
    double irradiance[most_bands] = {};
    const Vec3 point = state.forest.root_triangle(root).at(u, v);
    if (!solution_->exposure->sealed(patch[k], side, point))
      linear.at(state.forest.leaf_at(root, u, v), u, v, irradiance);
    for (int b = 0; b < bands; ++b) {
      const size_t at = static_cast<size_t>(patch[k]) * bands + b;
      values[b] = value_of(quantity, scene_.emission[at], scene_.reflectance[at], irradiance[b]);
    }
  }
}

int64_t Solver::leaf_count() const {
  require_solved();
  return solution_->state.forest.leaf_count();
}

LeafView Solver::leaf(int64_t index) const {
  const Forest& forest = solution_->state.forest;
  const Node& node = forest.nodes[leaves()[index]];
  const Surface& surface = forest.surfaces[node.surface];
  LeafView view;
  view.patch = surface.patch;
  view.face = scene_.face[surface.patch];
  view.side = surface.side;
  view.corners = forest.triangle(node);
  view.area = forest.area(node);
  view.exposed = node.exposed;
  return view;
}

void Solver::leaf_values(int64_t index, Quantity quantity, double* out) const {
  const NodeId leaf = leaves()[index];
  node_values(solution_->state, leaf, irradiance_of_all()[leaf], quantity, out);
}

void Solver::leaf_corner_radiosity(int64_t index, double* out) const {
  const State& state = solution_->state;
  const NodeId leaf = leaves()[index];
  const Node& node = state.forest.nodes[leaf];
  const size_t patch =
      static_cast<size_t>(state.forest.surfaces[node.surface].patch) * scene_.bands;
  double irradiance[3 * most_bands] = {};
  if (node.exposed > 0) reconstruction().corners(leaf, irradiance);
  for (int c = 0; c < 3; ++c)
    for (int b = 0; b < scene_.bands; ++b)
      out[c * scene_.bands + b] = scene_.emission[patch + b] +
                                  scene_.reflectance[patch + b] * irradiance[c * scene_.bands + b];
}

std::array<int32_t, 3> Solver::leaf_corner_numbers(int64_t index) const {
  return reconstruction().corner_numbers(leaves()[index]);
}

void Solver::power_balance(double* emitted, double* absorbed, double* absorbed_back,
                           double* escaped) const {
  require_solved();
  measure_if_due();
  if (solution_->measuring_due)
    fail(Status::state,
         "emission or reflectance changed after a solve with refine=0 whose balance nobody had "
         "asked for: call hrad_solve first");
  if (!solution_->finished)
    fail(Status::state,
         "the power of this light was not measured, because its solve was stopped: call "
         "hrad_solve, which goes on with it");
  const PowerBalance& balance = solution_->balance;
  const auto copy = [&](const std::vector<double>& from, double* to) {
    if (!to) return;
    for (int b = 0; b < scene_.bands; ++b) to[b] = from.empty() ? 0 : from[b];
  };
  copy(balance.emitted, emitted);
  copy(balance.absorbed, absorbed);
  copy(balance.absorbed_back, absorbed_back);
  copy(balance.escaped, escaped);
}

}  // namespace hrad
