// The options of `hrad solve` that keep it from losing its work: where checkpoints go and how
// often, what to go on from, when to stop. CLI: public headers only.
#pragma once

#include <optional>
#include <string>

#include "arguments.h"
#include "output_files.h"
#include "run_options.h"

namespace hrad::cli {

// What was asked for.
struct CheckpointPlan {
  std::string path;               // "": no checkpoints
  double interval_seconds = 600;  // between two of them
  std::optional<int64_t> keep;    // older ones; none: as the parameter says
  bool resumable = true;          // unless the parameter says otherwise
  std::string restart;            // the file to go on from, "": none
  bool restart_auto = false;      // from `path` or one that was kept, if there is one
  double time_limit = 0;          // s; 0: none
};

class CheckpointOptions {
 public:
  void add_to(Arguments* arguments);
  // Failure (usage, input/output). Call after parsing and after the other options were checked.
  CheckpointPlan check(const RunOptions& run, const OutputFiles& files) const;

 private:
  void check_files(const CheckpointPlan& plan, const RunOptions& run,
                   const OutputFiles& files) const;

  std::optional<std::string> checkpoint_, interval_, keep_, restart_, time_limit_;
};

}  // namespace hrad::cli
