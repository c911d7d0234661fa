// The exchange of a process that owns every surface.
#pragma once

#include <vector>

#include "machine/comm_self.h"
#include "stages/exchange.h"

namespace hrad_test {

class Alone {
 public:
  explicit Alone(const hrad::State& state)
      : exchange(comm, std::vector<int32_t>(state.forest.surfaces.size(), 0)) {}
  Alone(const Alone&) = delete;
  Alone& operator=(const Alone&) = delete;

 private:
  hrad::CommSelf comm;

 public:
  hrad::Exchange exchange;
};

}  // namespace hrad_test
