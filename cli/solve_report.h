// What `hrad solve` says of a solve, for people and as JSON. CLI: public headers only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hrad/hrad.h"
#include "session.h"

namespace hrad::cli {

struct SolveReport {
  std::string scene;
  hrad_status status = HRAD_OK;
  hrad_stats stats{};
  std::vector<double> emitted, absorbed, absorbed_back, escaped;  // W per band
  std::string hash;                                               // 16 hexadecimal digits
  std::string unit;                                               // of lengths
  std::vector<std::string> diagnostics, files;
};

// Asks the solver; `seconds_output` was spent writing `files`.
SolveReport make_report(Session* session, const std::string& scene, int exit_code,
                        const std::vector<std::string>& files, double seconds_output);

void append_summary(std::string* text, const SolveReport& report);
void append_json(std::string* text, const SolveReport& report);

std::string hash_text(const hrad_solver* solver);

}  // namespace hrad::cli
