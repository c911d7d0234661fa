// Counts and times of a solver; the C API's hrad_stats is filled from this. Floor 8 (solver).
#pragma once

#include <cstdint>

namespace hrad {

struct Stats {
  bool converged = false;
  int32_t ranks = 1, threads = 1;
  int32_t up_axis = 0;  // 1 y, 2 z, 0 where nobody has said
  int64_t rounds = 0, iterations = 0;
  int64_t patches = 0, elements = 0, leaves = 0, links = 0, swept_links = 0;
  int64_t rays = 0, pairs = 0;
  double area = 0, sealed_area = 0, back_share = 0;
  double error_estimate = -1, error_standard_error = 0;
  double seconds_load = 0, seconds_initial = 0, seconds_linking = 0, seconds_iterative = 0,
         seconds_output = 0;
  double cpu_seconds = 0;
  int64_t memory_peak_bytes = 0, link_bytes = 0, node_bytes = 0;
  int64_t messages[3] = {0, 0, 0}, message_bytes[3] = {0, 0, 0};
};

}  // namespace hrad
