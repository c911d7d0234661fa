// One solver for the length of a command: created with the options' parameters, its statuses turned
// into failures with exit codes, its messages and progress shown. CLI: public headers only.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hrad/hrad.h"
#include "progress.h"
#include "run_options.h"
#include "terminal.h"

namespace hrad::cli {

class Session {
 public:
  // goes_on: a solution in a .hrad file may be solved further, else it is taken as it is.
  explicit Session(const RunOptions& options, bool goes_on = false);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  hrad_solver* solver() const { return solver_; }
  Terminal& terminal() { return terminal_; }

  void load();  // the options' scene, or the solution of a .hrad file
  // A checkpoint of the scene that was loaded; the options' parameters must agree with it. Failure
  // (checkpoint, usage).
  void restart(const std::string& path);
  // The Initial Stage, for what only rays find out about a scene: "", or why it can't be solved.
  std::string inspect();
  // exit_done or exit_not_converged; Interrupted when a signal stopped it.
  int solve();
  // For who stops and goes on: one call of hrad_solve. stops: asked with every progress.
  using StopTest = std::function<bool(const hrad_progress&)>;
  hrad_status solve_until(const StopTest& stops);
  // What there is to say at the end of a solve, and its exit code.
  int conclude(hrad_status status);
  // A solution as a file of its own: no older ones are kept.
  void write_result(const std::string& path);

  bool scene_is_file() const { return options_.scene_is_file(); }
  int64_t bands() const;
  int64_t patches() const;
  std::string parameter(const char* name) const;
  hrad_stats stats() const;
  std::vector<std::string> diagnostics() const;

 private:
  static void log(int32_t level, const char* message, void* user);
  static int32_t show_progress(const hrad_progress* progress, void* user);
  void warn_of_diagnostics();
  void set_parameters(bool result_too);
  void agree_with_file(const std::string& path);
  int take_as_it_is();

  RunOptions options_;
  const bool goes_on_;
  double seconds_before_ = 0;  // of the calls of hrad_solve that are over
  StopTest stops_;
  Terminal terminal_;
  Progress progress_;
  hrad_solver* solver_ = nullptr;
  std::vector<std::string> warnings_;  // already said
};

// Failure with the library's message when a status is an error.
void check(hrad_status status);
int exit_code_of(hrad_status status);

// A text that the library writes into a caller's buffer.
using TextFunction = std::function<hrad_status(char* text, int64_t size, int64_t* needed)>;
std::string fetch_text(const TextFunction& function);

// All rows of the table of parameters.
std::vector<hrad_param> parameter_table();
// Whether it decides the bits of a result; false where there is no such parameter.
bool is_result_parameter(const std::string& name);

}  // namespace hrad::cli
