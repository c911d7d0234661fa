// What the stated accuracy means for the stages: thresholds of the oracle in each round, and when
// the sweeps may stop. Floor 8 (solver).
#pragma once

#include "links/oracle.h"
#include "solver/params.h"
#include "stages/rows.h"
#include "stages/state.h"
#include "visibility/inspection.h"

namespace hrad {

// What missed the accuracy is solved again so often at the most, with thresholds that are so much
// smaller at the most, each time.
constexpr int most_tightenings = 2;
constexpr double least_tightening = 0.5;
constexpr double least_scale = least_tightening * least_tightening;
static_assert(most_tightenings == 2, "least_scale is that of two");

// Refinement rounds before the first measurement. Fewer lose light: a source that is still dark
// when its links are weighed is never refined for.
constexpr int first_rounds = 5;

// The oracle of round `round` (0: the Linking Stage). scale: 1, less after a measurement has shown
// that the accuracy was missed. Thresholds fall to their last value over the first rounds
// (multigridding: Hanrahan, Saltzman, Aupperle 1991, Section 4.3).
OracleSettings oracle_of_round(const Params& params, const State& state, int round, double scale);

// True when light is linked by rows: asked for, or chosen by linking=auto.
bool by_rows(const Params& params, const Forest& forest, const Inspection& inspection);

// Rows of rays; distance: the mean one between surfaces.
RowSettings rows_of(const Params& params, const Forest& forest, double distance, double scale);

// About how much longer linking by rows takes when thresholds are multiplied by `tightening`.
double growth_of_linking(double tightening);

// Share of the transported light that may be missing when the sweeps of a round stop.
double sweep_tolerance(const Params& params, int round);

}  // namespace hrad
