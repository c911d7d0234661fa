// Measuring a solution after its sweeps, by rays of its own: how far it is from what its own light
// would bring, and where the power goes. Floor 8 (solver).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "solver/residuals.h"
#include "stages/light_of_all.h"
#include "stages/state.h"

namespace hrad {

// By the definition of the accuracy.
struct ErrorEstimate : MeasuredError {
  int64_t rays = 0;
};

// Irradiance by rays against the solution's own on patches drawn by area. What is measured is the
// residual of one bounce, of several where much is reflected; its mean is carried on through all
// further bounces. What each patch has shown is kept in the journal. so_far: told now and then what
// is known already, may be empty. Nothing: stopped.
std::optional<ErrorEstimate> estimate_error(
    State& state, const LightOfAll& radiosity, const StageTools& tools, double accuracy,
    const std::function<void(const MeasuredError&)>& so_far = {});
// For how many rays, of those that go alone, it may go on, before anything is known of the error.
double expected_rays_of_estimate(double accuracy);

struct PowerBalance {
  std::vector<double> emitted, absorbed, absorbed_back, escaped;  // W per band
  double back_share = 0;  // of the rays sent: those that met a black back
  int64_t rays = 0;
};

constexpr int64_t rays_of_the_balance = 131072;

// Emitted by emission and areas, absorbed by fronts by the links' irradiance, the rest by rays that
// carry the leaving power. Nothing: stopped.
std::optional<PowerBalance> measure_balance(State& state, const LightOfAll& radiosity,
                                            const StageTools& tools);

}  // namespace hrad
