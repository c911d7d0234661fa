// What a solver holds from the Initial Stage on. Floor 8 (solver).
#pragma once

#include <memory>
#include <vector>

#include "machine/thread_team.h"
#include "solver/measure.h"
#include "solver/reconstruction.h"
#include "solver/solver.h"
#include "stages/convergence.h"
#include "stages/state.h"
#include "visibility/inspection.h"

namespace hrad {

struct Solver::Solution {
  explicit Solution(const Scene& scene) : state(scene) {}

  std::unique_ptr<ThreadTeam> team;
  std::unique_ptr<VisibilityEngine> engine;
  std::unique_ptr<Exposure> exposure;
  Inspection inspection;
  State state;

  // How far the solve has come, so that it can stop anywhere and go on to the same bits.
  bool linked = false;
  int rounds_done = 0;          // refinement rounds whose sweeps are done
  int tightened = 0;            // times the thresholds were lowered after measuring
  double scale = 1;             // of the thresholds, after that
  bool sweeping = false;        // sweeps are under way
  int sweeping_round = 0;       // those of this round, whose links are refined already
  Convergence convergence{0};   // of these sweeps
  bool from_emission = false;   // these sweeps began with B = E on the links as they are
  int64_t earlier_sweeps = 0;   // for other lights: max_iterations counts from there
  bool converged = false;       // the last sweeps stood still
  bool finished = false;        // measured
  bool measuring_due = false;   // not yet: when somebody asks
  double accuracy_reached = 0;  // the accuracy that was asked for then
  uint64_t light_hash = 0;      // of the emission and reflectance that light was swept for
  uint64_t mesh_hash = 0;       // likewise, that mesh and links were made for

  // Error and balance by rays, into stats and balance.
  void measure(const StageTools& tools, double accuracy, Stats& stats);

  // For queries, made when the solve is finished or stopped.
  std::vector<NodeId> leaves;  // in key order
  std::unique_ptr<Reconstruction> reconstruction;
  PowerBalance balance;
};

// Of emission and reflectance.
uint64_t hash_of_light(const Scene& scene);

}  // namespace hrad
