// What a solver holds from the Initial Stage on. Floor 8 (solver).
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "machine/thread_team.h"
#include "solver/measure.h"
#include "solver/reconstruction.h"
#include "solver/solve_progress.h"
#include "solver/solver.h"
#include "stages/exchange.h"
#include "stages/state.h"
#include "visibility/inspection.h"

namespace hrad {

struct Solver::Solution : SolveProgress {
  explicit Solution(const Scene& scene) : state(scene) {}

  std::unique_ptr<ThreadTeam> team;
  std::unique_ptr<Exchange> exchange;
  std::unique_ptr<VisibilityEngine> engine;
  std::unique_ptr<Exposure> exposure;
  Inspection inspection;
  State state;

  // Error and balance by rays, into stats and balance. False: stopped, and nothing has changed.
  bool measure(const StageTools& tools, double accuracy, Stats& stats,
               const std::function<void(const MeasuredError&)>& so_far = {});

  PowerBalance balance;

  // What queries want, each made when it is first asked for, and thrown away by the next solve.
  struct Answers {
    std::vector<NodeId> leaves;  // in key order
    std::unique_ptr<LightOfAll> radiosity, irradiance;
    std::unique_ptr<Reconstruction> reconstruction;
  };
  Answers answers;
  const LightOfAll& light_of_all(std::unique_ptr<LightOfAll>& answer,
                                 GrowingArray<float> State::*quantity);
};

// Of emission and reflectance.
uint64_t hash_of_light(const Scene& scene);
// Of all that decides what is linked, light as the hash of it.
uint64_t hash_of_linking(const Params& params, uint64_t light, double scale);

}  // namespace hrad
