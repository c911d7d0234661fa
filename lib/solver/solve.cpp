// Solving: the stages in the order of the paper's Fig. 1. Floor 8 (solver).
#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/error.h"
#include "base/hash.h"
#include "machine/process_usage.h"
#include "solver/progress_clock.h"
#include "solver/same_everywhere.h"
#include "solver/schedule.h"
#include "solver/solution.h"
#include "stages/exposed_shares.h"
#include "stages/gather.h"
#include "stages/linking.h"
#include "stages/rebalance.h"
#include "stages/refine.h"
#include "stages/rows.h"
#include "stages/state_memory.h"
#include "stages/sweep.h"

namespace hrad {
namespace {

// How often the thresholds are lowered when a measurement shows that the accuracy was missed.
// Only a miss by this factor, and of an error that can be told from noise, is a failure: the
// measurement is a sample.
constexpr double surely_missed = 2, least_measurable = 0.02;
constexpr int most_tightenings = 2;

uint64_t hash_of_radiosity(const State& state) {
  Hasher hash;
  for (const auto* light : {&state.radiosity, &state.irradiance})
    for (float value : *light) hash.add(value);
  return hash.value();
}

void measure_roots(State& state, const StageTools& tools) {
  std::vector<NodeId> roots;
  for (NodeId root = 0; root < state.forest.surface_count(); ++root) roots.push_back(root);
  measure_exposure(state, tools, roots);
}

}  // namespace

// One call of solve(): the stages with what they share.
class Solver::Run {
 public:
  Run(Solver& solver)
      : solver_(solver),
        solution_(*solver.solution_),
        state_(solver.solution_->state),
        params_(solver.params_),
        by_rows_(by_rows(params_, state_.forest, solution_.inspection)),
        exchange_(*solver.solution_->exchange),
        clock_(
            [&solver](const Progress& p) {
              const bool asked = solver.comm_->rank() == 0 && solver.progress_;
              const bool stop = solver.stop_requested_.load(std::memory_order_relaxed) ||
                                (asked && !solver.progress_(p));
              if (stop) solver.comm_->raise();
              return !stop && !solver.comm_->raised();
            },
            solver.observer_) {}

  Status run() {
    if (params_.refine == 0) return sweep_again();
    start_over_if_the_light_changed();
    // Sweeps that a stop broke off go on first.
    if (solution_.sweeping && !sweep(solution_.sweeping_round)) return Status::stopped;
    if (!solution_.linked && !link()) return Status::stopped;
    // More sweeps are allowed now than when they ran out.
    if (solution_.finished && !solution_.converged && !out_of_sweeps()) {
      solution_.finished = false;
      if (!sweep(by_rows_ ? first_rounds : solution_.rounds_done)) return Status::stopped;
    }
    for (;;) {
      while (solution_.rounds_done < rounds_wanted() && !out_of_sweeps())
        if (!round()) return Status::stopped;
      const Status status = finish();
      if (!tighten()) return status;
      if (!solution_.linked && !link()) return Status::stopped;
    }
  }

 private:
  int rounds_wanted() const { return by_rows_ ? 0 : first_rounds + solution_.tightened; }
  bool out_of_sweeps() const {
    return solver_.stats_.iterations - solution_.earlier_sweeps >= params_.max_iterations;
  }

  StageTools tools(int oracle_round) {
    return {*solution_.team,
            exchange_,
            *solution_.engine,
            *solution_.exposure,
            oracle_of_round(params_, state_, oracle_round, solution_.scale),
            [this](double fraction) { return clock_.report(fraction, solver_.stats_.iterations); }};
  }

  // refine=0: sweeps over the present links from B = E. Nothing of the light before is left, so
  // that the result is that of mesh, links, emission and reflectance alone.
  Status sweep_again() {
    const uint64_t light = hash_of_light(solver_.scene_);
    const bool goes_on =
        solution_.sweeping && solution_.from_emission && light == solution_.light_hash;
    solution_.light_hash = light;
    if (!goes_on) begin_from_emission(first_rounds);
    solution_.finished = solution_.measuring_due = false;
    solver_.stats_.error_estimate = -1;
    solver_.stats_.error_standard_error = 0;
    solution_.balance = PowerBalance{};
    if (!sweep(solution_.sweeping_round) && solution_.sweeping) return Status::stopped;
    // Rays would take longer than the sweeps.
    solution_.measuring_due = true;
    clock_.report(1.0, solver_.stats_.iterations);
    return solution_.converged ? Status::ok : Status::not_converged;
  }

  void start_over_if_the_light_changed() {
    const uint64_t light = hash_of_light(solver_.scene_);
    const bool other_mesh = solution_.linked && light != solution_.mesh_hash;
    const bool other_light = solution_.linked && light != solution_.light_hash;
    const bool more_accurate = params_.accuracy < solution_.accuracy_reached;
    solution_.light_hash = solution_.mesh_hash = light;
    solution_.accuracy_reached = params_.accuracy;
    if (other_mesh || other_light || more_accurate)
      solution_.finished = solution_.measuring_due = false;
    // Of pairs and clusters the mesh stays; the last round looks at every link again under the new
    // light.
    if (!by_rows_ && (other_mesh || more_accurate))
      solution_.rounds_done = std::min(solution_.rounds_done, first_rounds - 1);
    if (other_mesh || other_light)
      begin_from_emission(by_rows_ ? first_rounds : solution_.rounds_done);
    // By rows it follows the light; and the method may be another for another accuracy.
    const bool other_method = solution_.linked && state_.cells.empty() == by_rows_;
    if (other_method) clear_state();
    if (other_method || (by_rows_ && (other_mesh || more_accurate))) {
      solution_.linked = solution_.sweeping = false;
      solution_.tightened = 0;
      solution_.scale = 1;
    }
  }

  void clear_state() {
    clear(state_);
    exchange_.forget();
  }

  void begin_from_emission(int round) {
    reset_to_emission(state_);
    begin_sweeps(round);
    solution_.from_emission = true;
    solution_.earlier_sweeps = solver_.stats_.iterations;
  }

  void begin_sweeps(int round) {
    solution_.sweeping = true;
    solution_.from_emission = false;
    solution_.sweeping_round = round;
    solution_.convergence = Convergence(sweep_tolerance(params_, round));
  }

  bool link() {
    const auto start = std::chrono::steady_clock::now();
    begin_journal(hash_of_linking(params_, solution_.light_hash, solution_.scale));
    const bool done = by_rows_                        ? link_by_rows()
                      : params_.linking == "clusters" ? link_by_clusters()
                                                      : link_by_pairs();
    solver_.stats_.seconds_linking +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!done) {
      state_.rays = state_.journal.rays_before;
      return false;
    }
    state_.journal.clear();
    solution_.linked = true;
    solution_.rounds_done = 0;
    return sweep(by_rows_ ? first_rounds : 0);
  }

  void begin_journal(uint64_t key) {
    state_.journal.begin(key, state_.rays);
    state_.journal.recording = params_.resumable != 0;
  }

  bool link_by_pairs() {
    clock_.begin("linking", 0.02, 0.25);
    StageTools stage = tools(0);
    measure_roots(state_, stage);
    reset_to_emission(state_);
    state_.links.resize(state_.forest.nodes.size());
    return link_pairs(state_, stage, expected_brightness(state_));
  }

  bool link_by_clusters() {
    clock_.begin("linking", 0.02, 0.1);
    StageTools stage = tools(0);
    measure_roots(state_, stage);
    if (state_.forest.clusters.empty()) add_clusters(state_.forest);
    state_.links.resize(state_.forest.nodes.size());
    reset_to_emission(state_);
    return hrad::link_clusters(state_, stage, expected_brightness(state_));
  }

  bool link_by_rows() {
    clear_state();
    clock_.begin("linking", 0.02, 0.85);
    const StageTools stage = tools(first_rounds);
    measure_roots(state_, stage);
    return link_rows(
        state_, stage,
        rows_of(params_, state_.forest, solution_.inspection.mean_distance, solution_.scale));
  }

  bool round() {
    const int number = solution_.rounds_done + 1;
    const double from = 0.25 + 0.7 * share_of_rounds(number - 1);
    const double whole = share_of_rounds(number) - share_of_rounds(number - 1);
    clock_.begin("refine", from, from + 0.95 * whole);
    const auto start = std::chrono::steady_clock::now();
    // The last round tells best what surfaces cost; before the first one there are their links.
    if (work_.empty()) work_ = links_of_surfaces(state_, exchange_);
    rebalance(state_, exchange_, work_);
    // Every decision of a round follows from the light that it begins with.
    begin_journal(mix(hash_of_linking(params_, solution_.light_hash, solution_.scale),
                      static_cast<uint64_t>(number), hash_of_radiosity(state_)));
    const Brightness brightness = measure_brightness(state_, *solution_.team, exchange_);
    const bool done = refine_links(state_, tools(number), brightness, &work_);
    solver_.stats_.seconds_iterative +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!done) return false;
    state_.journal.clear();
    ++solver_.stats_.rounds;
    solution_.rounds_done = number;
    return sweep(number);
  }

  // Every round takes about twice as long as the one before.
  double share_of_rounds(int done) const {
    return std::min(1.0, (std::ldexp(1.0, done) - 1) / (std::ldexp(1.0, rounds_wanted()) - 1));
  }

  // Gathering and push-pull until the radiosity transported stands still; goes on where a stop
  // broke it off.
  bool sweep(int round) {
    const auto start = std::chrono::steady_clock::now();
    clock_.begin("sweep", clock_.fraction(), clock_.fraction() + 0.02);
    if (!solution_.sweeping) begin_sweeps(round);
    StageMemory memory(state_);
    memory.take(bytes_of_gather_space(state_), "the light of a sweep");
    GatherSpace space;
    bool going_on = true;
    solution_.converged = false;
    while (going_on && !solution_.converged && !out_of_sweeps()) {
      solution_.converged =
          solution_.convergence.reached(hrad::sweep(state_, *solution_.team, exchange_, space));
      ++solver_.stats_.iterations;
      solution_.sweeping = !solution_.converged && !out_of_sweeps();
      going_on = exchange_.all_go_on(clock_.report(0.5, solver_.stats_.iterations));
    }
    exchange_.share_light(state_);
    solver_.stats_.seconds_iterative +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    solution_.sweeping = !solution_.converged && !out_of_sweeps();
    return going_on;
  }

  // Measures the solution and makes it ready for queries.
  Status finish() {
    clock_.begin("measure", 0.95, 1.0);
    const StageTools stage = tools(first_rounds);
    if (!solution_.finished) solution_.measure(stage, params_.accuracy, solver_.stats_);
    clock_.report(1.0, solver_.stats_.iterations);
    const bool missed = steered_by_accuracy() &&
                        error_but(3) > std::max(surely_missed * params_.accuracy, least_measurable);
    return solution_.converged && !missed ? Status::ok : Status::not_converged;
  }

  // The measured error less so many of its standard errors.
  double error_but(double standard_errors) const {
    return solver_.stats_.error_estimate - standard_errors * solver_.stats_.error_standard_error;
  }
  bool steered_by_accuracy() const { return params_.tolerance <= 0 && params_.oracle != "energy"; }

  // True when there is something left to try.
  bool tighten() {
    if (!solution_.converged || !steered_by_accuracy() || !(error_but(2) > params_.accuracy) ||
        solution_.tightened >= most_tightenings)
      return false;
    const double error = solver_.stats_.error_estimate;
    solution_.scale *= std::max(0.5, std::min(0.7, 0.7 * params_.accuracy / error));
    ++solution_.tightened;
    solution_.finished = false;
    if (by_rows_) solution_.linked = false;
    return true;
  }

  Solver& solver_;
  Solution& solution_;
  State& state_;
  const Params& params_;
  const bool by_rows_;
  Exchange& exchange_;
  std::vector<double> work_;  // of each own surface in the last round
  ProgressClock clock_;
};

Status Solver::solve() {
  if (params_.refine == 0 && !solved())
    fail(Status::state, "there are no links to sweep over: solve once with refine=1 before");
  const double cpu = user_seconds();
  if (solution_) check_same_everywhere(*comm_, params_, scene_);
  partition();
  begun_ = true;
  // A stop that was asked for before the solve began holds too.
  Status status;
  solving_ = true;
  try {
    status = Run(*this).run();
    solving_ = false;
  } catch (...) {
    solving_ = false;
    // Half a round may be in place, and nothing of it can be trusted: back to the loaded scene.
    solution_.reset();
    begun_ = false;
    const double seconds_load = stats_.seconds_load;
    stats_ = Stats{};
    stats_.seconds_load = seconds_load;
    stop_requested_.store(false);
    throw;
  }
  stop_requested_.store(false);
  stats_.converged = status == Status::ok;
  stats_.cpu_seconds += user_seconds() - cpu;
  solution_->reconstruction.reset();
  if (params_.refine != 0) solution_->leaves = solution_->state.forest.leaves();
  return status;
}

}  // namespace hrad
