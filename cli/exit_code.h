// The exit codes of hrad, and the failure that carries one to main. CLI: public headers only.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace hrad::cli {

enum ExitCode : int {
  exit_done = 0,
  exit_usage = 2,
  exit_scene = 3,
  exit_checkpoint = 4,
  exit_input_output = 5,
  exit_memory = 6,
  exit_not_converged = 7,
  exit_mpi = 8,
  exit_internal = 70,
  exit_stopped = 75,
  exit_signal = 128  // plus the signal's number
};

// Ends a command: main prints the message and the hint on stderr and exits with the code.
class Failure : public std::runtime_error {
 public:
  Failure(int code, const std::string& message, std::string hint = {})
      : std::runtime_error(message), code_(code), hint_(std::move(hint)) {}
  int code() const { return code_; }
  const std::string& hint() const { return hint_; }

 private:
  int code_;
  std::string hint_;
};

// Ends a command because a signal asked for it.
struct Interrupted {
  int signal;
};

}  // namespace hrad::cli
