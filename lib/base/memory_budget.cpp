// Counting against the limit. Floor 1 (base).
#include "base/memory_budget.h"

#include "base/error.h"

namespace hrad {

void MemoryBudget::take(int64_t bytes, const char* what) {
  constexpr double mebibyte = 1024 * 1024;
  const int64_t before = used_.fetch_add(bytes);
  if (bytes <= 0 || limit_ <= 0 || before + bytes <= limit_) return;
  used_.fetch_sub(bytes);
  fail(Status::memory,
       "the memory limit is reached: %s need %.3g MiB more and %.3g MiB are in use, but max_memory "
       "is %lld bytes (%.3g MiB): raise it, or use a larger accuracy or min_area",
       what, static_cast<double>(bytes) / mebibyte, static_cast<double>(before) / mebibyte,
       static_cast<long long>(limit_), static_cast<double>(limit_) / mebibyte);
}

}  // namespace hrad
