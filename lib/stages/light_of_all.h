// Radiosity or irradiance of all nodes, for whoever looks anywhere: rounds of refinement, rays,
// pictures, checkpoints. Floor 7 (stages).
#pragma once

#include <cstddef>

#include "base/growing_array.h"
#include "stages/exchange.h"
#include "stages/state.h"
#include "stages/state_memory.h"

namespace hrad {

// A process that is alone looks at what it has, which others know a part of: they tell each other.
class LightOfAll {
 public:
  // Collective. Of &State::radiosity or &State::irradiance, as it is now; state must outlive this.
  LightOfAll(State& state, GrowingArray<float> State::*quantity, const Exchange& exchange,
             ThreadTeam& team);
  // bands values.
  const float* operator[](NodeId id) const {
    return values_->data() + static_cast<size_t>(id) * bands_;
  }

 private:
  const size_t bands_;
  StageMemory memory_;
  GrowingArray<float> told_;
  const GrowingArray<float>* values_;
};

}  // namespace hrad
