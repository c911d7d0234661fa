// What this process has taken so far. Floor 2 (machine).
#pragma once

#include <cstdint>

namespace hrad {

double user_seconds();  // of all threads
int64_t peak_memory();  // bytes

}  // namespace hrad
