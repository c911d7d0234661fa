// What this process, or a thread of it, has taken so far. Floor 2 (machine).
#pragma once

#include <cstdint>

namespace hrad {

double user_seconds();    // of all threads
double thread_seconds();  // CPU of the calling thread
int64_t peak_memory();    // bytes

}  // namespace hrad
