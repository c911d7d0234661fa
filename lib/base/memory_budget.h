// How much memory the large arrays of a solver may take together. Whoever makes one grow asks first;
// what is asked for depends on sizes alone, so that a limit strikes or not whatever the number of
// threads. Floor 1 (base).
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

namespace hrad {

// What an array takes.
template <class T>
int64_t bytes_in(const std::vector<T>& array) {
  return static_cast<int64_t>(array.capacity() * sizeof(T));
}

class MemoryBudget {
 public:
  // bytes: 0 for no limit.
  void set_limit(int64_t bytes) { limit_ = bytes; }
  int64_t used() const { return used_.load(); }

  // Counts bytes about to be used, or no longer used when negative. MEMORY, and nothing is counted,
  // when that is more than the limit; what: "links". Any thread.
  void take(int64_t bytes, const char* what);

 private:
  int64_t limit_ = 0;
  std::atomic<int64_t> used_{0};
};

}  // namespace hrad
