// One call of solve(): the stages in the order of the paper's Fig. 1, with what they share.
// Floor 8 (solver).
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

#include "solver/progress_clock.h"
#include "solver/schedule.h"
#include "solver/solution.h"

namespace hrad {

class Solver::Run {
 public:
  // start: of the call, whose progress counts from there.
  Run(Solver& solver, std::chrono::steady_clock::time_point start);
  Status run();

 private:
  // What is to be done (solve.cpp).
  Status sweep_again();
  void start_over_if_the_light_changed();
  void clear_state();
  Status finish();
  bool is_to_be_tightened() const;
  void tighten();
  void forget_measurements();
  int rounds_wanted() const { return by_rows_ ? 0 : first_rounds + solution_.tightened; }
  bool out_of_sweeps() const {
    return solver_.stats_.iterations - solution_.earlier_sweeps >= params_.max_iterations;
  }
  // The measured error less so many of its standard errors.
  double error_but(double standard_errors) const {
    return solver_.stats_.error_estimate - standard_errors * solver_.stats_.error_standard_error;
  }
  bool may_be_tightened() const {
    return solution_.converged && steered_by_accuracy() && solution_.tightened < most_tightenings;
  }
  // By what thresholds are multiplied when so large an error has been measured.
  double tightening_for(double error) const {
    return std::max(least_tightening, std::min(0.7, 0.7 * params_.accuracy / error));
  }
  bool steered_by_accuracy() const { return params_.tolerance <= 0 && params_.oracle != "energy"; }

  // The stages (solve_stages.cpp). False: stopped.
  StageTools tools(int oracle_round);
  void begin_from_emission(int round);
  void begin_sweeps(int round);
  bool link();
  void begin_journal(uint64_t stage);
  void forget_journal();
  bool link_by_pairs();
  bool link_by_clusters();
  bool link_by_rows();
  bool round();
  bool refine(int number);
  // Seconds that are still to come, as far as anybody knows (solve_stages.cpp).
  double of_measuring() const;
  double of_solving_again() const;
  double of_later_rounds(int done, double seconds_of_last) const;
  bool sweep(int round);
  bool measure();

  Solver& solver_;
  Solution& solution_;
  State& state_;
  const Params& params_;
  const bool by_rows_;
  Exchange& exchange_;
  std::vector<double> work_;  // of each own surface in the last round
  // Of the last ones; of linking, where it is to be done again, what that may take.
  double seconds_of_linking_ = 0, seconds_of_round_ = 0, seconds_of_sweeps_ = 0;
  MeasuredError error_so_far_;  // while it is being measured
  ProgressClock clock_;
};

}  // namespace hrad
