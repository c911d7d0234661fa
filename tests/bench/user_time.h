// User CPU of this process: what benchmarks on a shared machine may compare.
#pragma once

#include <sys/resource.h>

namespace bench {

inline double user_seconds() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

}  // namespace bench
