// How far a solve has come, so that it can stop anywhere and go on to the same bits: in a solver
// and in a checkpoint. Floor 8 (solver).
#pragma once

#include <cstdint>

#include "stages/convergence.h"

namespace hrad {

struct SolveProgress {
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
};

}  // namespace hrad
