// A partition before anything is solved: the work that each patch will make, guessed, and what each
// rank would get by a method (paper, Section 3.1). Floor 8 (solver).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "partition/partition.h"
#include "solver/params.h"
#include "stages/state.h"
#include "visibility/inspection.h"

namespace hrad {

// Per patch, about the rays that linking will trace from it: geometry and accuracy alone, whatever
// light will make of it. The sides of a patch count both.
std::vector<double> predicted_work(const Params& params, const State& state,
                                   const Inspection& inspection, const Exposure& exposure);

struct PartitionPlan {
  std::vector<double> work;     // per patch, predicted
  std::vector<int32_t> owners;  // per patch
  std::vector<RankLoad> loads;  // per rank
  // Per rank, of the light that comes to it from surfaces, the share that comes from surfaces of
  // other ranks: those links need messages. By a sample of rays, drawn by work: off by some
  // percent.
  std::vector<double> remote;
};

// ARGUMENT for an unknown method. The same for any number of threads.
PartitionPlan plan_partition(const State& state, const VisibilityEngine& engine,
                             std::vector<double> work, const std::string& method, int32_t ranks);

}  // namespace hrad
