// Linking, rounds of refinement, and sweeps until the light stands still. Floor 8 (solver).
#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/hash.h"
#include "solver/hash_of_own.h"
#include "solver/solve_run.h"
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

// To guess the time left: the rounds after linking and the sweeps after rows, in times of these;
// how much longer each round takes than the one before; and what nobody knows.
constexpr double rounds_of_linking = 1.5, sweeps_of_rows = 0.05, growth_of_rounds = 2.6;
constexpr TimeLeft::Expected unknown{-1};
// What a stage took before, as far as it is known, tells more of the next time than the pace: that
// of linking by rows changes from step to step, and in a round large tasks come first and leave
// most of their work to later passes.
TimeLeft::Expected as_before(double seconds) {
  return seconds > 0 ? TimeLeft::Expected{seconds, 1} : unknown;
}

// Names of stages in the journal's key; a round of refinement is its number.
constexpr uint64_t stage_of_linking = 0, stage_of_measuring = uint64_t{1} << 32;

// Collective.
uint64_t hash_of_light_on(const State& state, const Exchange& exchange) {
  return hash_of_own(state, exchange, [&](NodeId id) {
    Hasher hash;
    for (const float* light : {state.radiosity_of(id), state.irradiance_of(id)})
      for (int b = 0; b < state.bands; ++b) hash.add(light[b]);
    return hash.value();
  });
}

bool measure_roots(State& state, const StageTools& tools) {
  std::vector<NodeId> roots;
  for (NodeId root = 0; root < state.forest.surface_count(); ++root) roots.push_back(root);
  return measure_exposure(state, tools, roots);
}

}  // namespace

StageTools Solver::Run::tools(int oracle_round) {
  return {*solution_.team,
          exchange_,
          *solution_.engine,
          *solution_.exposure,
          oracle_of_round(params_, state_, oracle_round, solution_.scale),
          [this](double fraction) { return clock_.report(fraction, solver_.stats_.iterations); }};
}

void Solver::Run::begin_from_emission(int round) {
  reset_to_emission(state_, *solution_.team, exchange_);
  begin_sweeps(round);
  solution_.from_emission = true;
  solution_.earlier_sweeps = solver_.stats_.iterations;
}

void Solver::Run::begin_sweeps(int round) {
  solution_.sweeping = true;
  solution_.from_emission = false;
  solution_.sweeping_round = round;
  solution_.convergence = Convergence(sweep_tolerance(params_, round));
}

bool Solver::Run::link() {
  const auto start = std::chrono::steady_clock::now();
  const double later = by_rows_ ? sweeps_of_rows : rounds_of_linking;
  clock_.begin("linking", as_before(seconds_of_linking_),
               [this, later](double seconds) { return later * seconds + of_measuring(); });
  begin_journal(stage_of_linking);
  const bool done = by_rows_                        ? link_by_rows()
                    : params_.linking == "clusters" ? link_by_clusters()
                                                    : link_by_pairs();
  solver_.stats_.seconds_linking +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  seconds_of_linking_ = clock_.seconds_of_stage();
  if (!done) {
    state_.rays = state_.journal.rays_before;
    state_.pairs = state_.journal.pairs_before;
    return false;
  }
  forget_journal();
  solution_.linked = true;
  solution_.rounds_done = 0;
  return sweep(by_rows_ ? first_rounds : 0);
}

// All but linking follows from the light that the stage begins with.
void Solver::Run::begin_journal(uint64_t stage) {
  // How many processes keep one: each has a parameter of its own.
  uint64_t keep = params_.resumable != 0 || !state_.journal.empty();
  exchange_.comm().add_up({&keep, 1});
  const uint64_t light =
      keep > 0 && stage != stage_of_linking ? hash_of_light_on(state_, exchange_) : 0;
  const uint64_t key =
      mix(hash_of_linking(params_, solution_.light_hash, solution_.scale), stage, light);
  counted(state_, [&] { state_.journal.begin(key, state_.rays, state_.pairs); });
  state_.journal.recording = params_.resumable != 0;
}

void Solver::Run::forget_journal() {
  counted(state_, [&] { state_.journal.clear(); });
}

bool Solver::Run::link_by_pairs() {
  StageTools stage = tools(0);
  if (!measure_roots(state_, stage)) return false;
  reset_to_emission(state_, stage.team, exchange_);
  state_.links.resize(state_.forest.nodes.size());
  return link_pairs(state_, stage, expected_brightness(state_));
}

bool Solver::Run::link_by_clusters() {
  StageTools stage = tools(0);
  if (!measure_roots(state_, stage)) return false;
  if (state_.forest.clusters.empty()) add_clusters(state_.forest);
  state_.links.resize(state_.forest.nodes.size());
  reset_to_emission(state_, stage.team, exchange_);
  return hrad::link_clusters(state_, stage, expected_brightness(state_));
}

bool Solver::Run::link_by_rows() {
  clear_state();
  const StageTools stage = tools(first_rounds);
  if (!measure_roots(state_, stage)) return false;
  return link_rows(
      state_, stage,
      rows_of(params_, state_.forest, solution_.inspection.mean_distance, solution_.scale));
}

bool Solver::Run::round() {
  const int number = solution_.rounds_done + 1;
  clock_.begin("refine", as_before(growth_of_rounds * seconds_of_round_),
               [this, number](double seconds) {
                 return seconds_of_sweeps_ + of_later_rounds(number, seconds) + of_measuring();
               });
  const auto start = std::chrono::steady_clock::now();
  // The last round tells best what surfaces cost; before the first one there are their links.
  if (work_.empty()) work_ = links_of_surfaces(state_, exchange_);
  rebalance(state_, *solution_.team, exchange_, work_);
  begin_journal(static_cast<uint64_t>(number));
  const bool done = refine(number);
  solver_.stats_.seconds_iterative +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!done) return false;
  seconds_of_round_ = clock_.seconds_of_stage();
  forget_journal();
  ++solver_.stats_.rounds;
  solution_.rounds_done = number;
  return sweep(number);
}

bool Solver::Run::refine(int number) {
  const LightOfAll radiosity(state_, &State::radiosity, exchange_, *solution_.team);
  const Brightness brightness = measure_brightness(state_, radiosity, *solution_.team, exchange_);
  return refine_links(state_, tools(number), brightness, radiosity, &work_);
}

double Solver::Run::of_later_rounds(int done, double seconds_of_last) const {
  double seconds = 0;
  for (int round = done; round < rounds_wanted(); ++round)
    seconds += seconds_of_last *= growth_of_rounds;
  return seconds;
}

double Solver::Run::of_measuring() const {
  const double rays = expected_rays_of_estimate(params_.accuracy) + rays_of_the_balance;
  return rays * solution_.inspection.seconds_of_a_ray / solution_.team->size() /
         exchange_.owner_count();
}

// Gathering and push-pull until the radiosity transported stands still; goes on where a stop
// broke it off.
bool Solver::Run::sweep(int round) {
  const auto start = std::chrono::steady_clock::now();
  clock_.begin("sweep", {seconds_of_sweeps_}, [this, round](double) {
    return of_later_rounds(round, seconds_of_round_) + of_measuring();
  });
  if (!solution_.sweeping) begin_sweeps(round);
  const OwnRuns runs(state_, exchange_, *solution_.team);
  bool going_on = true;
  solution_.converged = false;
  while (going_on && !solution_.converged && !out_of_sweeps()) {
    solution_.converged =
        solution_.convergence.reached(hrad::sweep(state_, *solution_.team, exchange_, runs));
    ++solver_.stats_.iterations;
    solution_.sweeping = !solution_.converged && !out_of_sweeps();
    const double share = solution_.convergence.share_of_way();
    going_on = exchange_.all_go_on(clock_.report(share, solver_.stats_.iterations));
  }
  seconds_of_sweeps_ = clock_.seconds_of_stage();
  exchange_.finish_update(state_, *solution_.team);
  exchange_.share_roots(state_, *solution_.team);
  solver_.stats_.seconds_iterative +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  solution_.sweeping = !solution_.converged && !out_of_sweeps();
  return going_on;
}

// Where what is known of the error so far says that it will be wanted.
double Solver::Run::of_solving_again() const {
  const MeasuredError& known = error_so_far_;
  if (!may_be_tightened() || known.error - known.standard_error <= params_.accuracy) return 0;
  const double of_linking =
      by_rows_ ? seconds_of_linking_ * growth_of_linking(tightening_for(known.error))
               : growth_of_rounds * seconds_of_round_;
  return of_linking + seconds_of_sweeps_ + of_measuring();
}

bool Solver::Run::measure() {
  error_so_far_ = {};
  clock_.begin("measure", {of_measuring()}, [this](double) { return of_solving_again(); });
  begin_journal(stage_of_measuring);
  const auto so_far = [this](const MeasuredError& error) { error_so_far_ = error; };
  if (!solution_.measure(tools(first_rounds), params_.accuracy, solver_.stats_, so_far))
    return false;
  forget_journal();
  return true;
}

}  // namespace hrad
