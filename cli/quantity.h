// The quantities that --quantity names. CLI: public headers only.
#pragma once

#include <cstdint>
#include <string>

#include "hrad/hrad.h"

namespace hrad::cli {

struct Quantity {
  const char* name = "radiosity";
  int32_t number = HRAD_RADIOSITY;
};

// Failure (usage) of the command for a name that is none.
Quantity read_quantity(const std::string& name, const std::string& command);

}  // namespace hrad::cli
