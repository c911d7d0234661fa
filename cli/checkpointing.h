// A solve with checkpoints: goes on from one, writes one now and then, and ends with one when a
// signal or the time limit stops it. CLI: public headers only.
#pragma once

#include <chrono>
#include <optional>

#include "checkpoint_options.h"
#include "exit_code.h"
#include "pause.h"
#include "session.h"

namespace hrad::cli {

class Checkpointing {
 public:
  // The session must outlive this. The time limit counts from here.
  Checkpointing(Session* session, CheckpointPlan plan);

  // Takes the lock of the checkpoint, reads what the solve is to go on from; before it, the scene
  // is loaded. Failure when that can't be.
  void begin();
  // As Session::solve(). Failure with exit_stopped when it was stopped and the checkpoint is
  // written.
  int solve();
  // Failure when solve() came to its end and could not write the checkpoint of it.
  void check_end() const;
  // After a signal, wherever it was met: the checkpoint if there is anything new. Throws Failure
  // with exit_stopped, or returns where no checkpoint was asked for.
  void end_by_signal(int signal);

 private:
  using Clock = std::chrono::steady_clock;
  void restart_automatically();
  bool restart_from(const std::string& path);
  bool stops(const hrad_progress& progress);
  void warn(const std::string& what) const;
  bool out_of_time() const;
  void write();
  void write_on_the_way();
  [[noreturn]] void end_with_checkpoint(const std::string& why);
  bool has_news() const;

  Session* session_;
  const CheckpointPlan plan_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point last_written_ = Clock::now();
  bool begun_ = false;
  bool due_ = false;     // a checkpoint on the way
  bool pauses_ = false;  // the solve was stopped to write it
  Pause pause_;
  int64_t sweeps_written_ = -1;  // what the file under the checkpoint's name has, -1: not ours
  int32_t converged_written_ = 0;
  std::optional<Failure> failure_at_end_;
};

}  // namespace hrad::cli
