// By getrusage(2) and clock_gettime(2). Floor 2 (machine).
#include "machine/process_usage.h"

#include <sys/resource.h>
#include <time.h>

namespace hrad {
namespace {

rusage usage_so_far() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage;
}

}  // namespace

double user_seconds() {
  const timeval time = usage_so_far().ru_utime;
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

int64_t peak_memory() { return static_cast<int64_t>(usage_so_far().ru_maxrss) * 1024; }

}  // namespace hrad
