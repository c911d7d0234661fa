// What the progress line says (stage, percent, time left), and with --verbose a message for each
// stage. CLI: public headers only.
#pragma once

#include <string>

#include "hrad/hrad.h"
#include "terminal.h"

namespace hrad::cli {

class Progress {
 public:
  explicit Progress(Terminal* terminal) : terminal_(terminal) {}
  void show(const hrad_progress& progress);

 private:
  void announce_stage(const hrad_progress& progress);

  Terminal* terminal_;
  std::string stage_;  // the last one announced
  int percent_ = 0;    // the largest shown: the line never runs backwards
};

}  // namespace hrad::cli
