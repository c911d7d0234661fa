// What is left to do of a solve, and when it is done. Floor 8 (solver).
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "machine/process_usage.h"
#include "solver/same_everywhere.h"
#include "solver/solve_run.h"
#include "stages/state_memory.h"
#include "stages/sweep.h"

namespace hrad {
namespace {

// How often the thresholds are lowered when a measurement shows that the accuracy was missed.
// Only a miss by this factor, and of an error that can be told from noise, is a failure: the
// measurement is a sample.
constexpr double surely_missed = 2, least_measurable = 0.02;

}  // namespace

Solver::Run::Run(Solver& solver, std::chrono::steady_clock::time_point start)
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
          solver.observer_, start) {}

Status Solver::Run::run() {
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
    if (status == Status::stopped) return status;
    if (!is_to_be_tightened()) {
      clock_.finish(solver_.stats_.iterations);
      return status;
    }
    if (!exchange_.all_go_on(clock_.report(1.0, solver_.stats_.iterations))) return Status::stopped;
    tighten();
    if (!solution_.linked && !link()) return Status::stopped;
  }
}

// refine=0: sweeps over the present links from B = E. Nothing of the light before is left, so
// that the result is that of mesh, links, emission and reflectance alone.
Status Solver::Run::sweep_again() {
  const uint64_t light = hash_of_light(solver_.scene_);
  const bool goes_on =
      solution_.sweeping && solution_.from_emission && light == solution_.light_hash;
  solution_.light_hash = light;
  if (!goes_on) begin_from_emission(first_rounds);
  forget_measurements();
  if (!sweep(solution_.sweeping_round) && solution_.sweeping) return Status::stopped;
  // Rays would take longer than the sweeps.
  solution_.measuring_due = true;
  clock_.finish(solver_.stats_.iterations);
  return solution_.converged ? Status::ok : Status::not_converged;
}

void Solver::Run::start_over_if_the_light_changed() {
  const uint64_t light = hash_of_light(solver_.scene_);
  const bool other_mesh = solution_.linked && light != solution_.mesh_hash;
  const bool other_light = solution_.linked && light != solution_.light_hash;
  const bool more_accurate = params_.accuracy < solution_.accuracy_reached;
  solution_.light_hash = solution_.mesh_hash = light;
  solution_.accuracy_reached = params_.accuracy;
  if (other_mesh || other_light || more_accurate) forget_measurements();
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

// They were of another light, or of links that change.
void Solver::Run::forget_measurements() {
  solution_.finished = solution_.measuring_due = false;
  solver_.stats_.error_estimate = -1;
  solver_.stats_.error_standard_error = 0;
  solution_.balance = PowerBalance{};
}

void Solver::Run::clear_state() {
  clear(state_);
  counted(state_, [&] { exchange_.forget(state_); });
}

// Measures the solution and makes it ready for queries.
Status Solver::Run::finish() {
  if (!solution_.finished && !measure()) return Status::stopped;
  const bool missed = steered_by_accuracy() &&
                      error_but(3) > std::max(surely_missed * params_.accuracy, least_measurable);
  return solution_.converged && !missed ? Status::ok : Status::not_converged;
}

// When it missed the accuracy and there is something left to try.
bool Solver::Run::is_to_be_tightened() const {
  return may_be_tightened() && error_but(2) > params_.accuracy;
}

void Solver::Run::tighten() {
  const double tightening = tightening_for(solver_.stats_.error_estimate);
  solution_.scale *= tightening;
  seconds_of_linking_ *= growth_of_linking(tightening);
  ++solution_.tightened;
  solution_.finished = false;
  if (by_rows_) solution_.linked = false;
}

Status Solver::solve() {
  const double cpu = user_seconds();
  const auto start = std::chrono::steady_clock::now();
  // A stop that was asked for before the solve began holds too, and ends with it, however it ends.
  const struct TakeBack {
    std::atomic<bool>& request;
    ~TakeBack() { request.store(false); }
  } take_back{stop_requested_};
  if (params_.refine == 0 && !solved())
    fail(Status::state, "there are no links to sweep over: solve once with refine=1 before");
  if (solution_) check_same_everywhere(*comm_, params_, scene_);
  partition();
  begun_ = true;
  Status status;
  solution_->answers = Solution::Answers();
  solving_ = true;
  try {
    status = Run(*this, start).run();
    comm_->all_go_on();
    solving_ = false;
  } catch (...) {
    solving_ = false;
    // Half a round may be in place, and nothing of it can be trusted: back to the loaded scene.
    solution_.reset();
    begun_ = false;
    const double seconds_load = stats_.seconds_load;
    stats_ = Stats{};
    stats_.seconds_load = seconds_load;
    throw;
  }
  stats_.converged = status == Status::ok;
  stats_.cpu_seconds += user_seconds() - cpu;
  solution_->answers = Solution::Answers();
  return status;
}

}  // namespace hrad
