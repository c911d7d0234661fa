// A solver for one command (session.h). CLI: public headers only.
#include "session.h"

#include <algorithm>
#include <chrono>

#include "exit_code.h"
#include "launcher.h"
#include "numbers.h"
#include "signals.h"

namespace hrad::cli {

int exit_code_of(hrad_status status) {
  switch (status) {
    case HRAD_OK:
      return exit_done;
    case HRAD_NOT_CONVERGED:
      return exit_not_converged;
    case HRAD_STOPPED:
      return exit_stopped;
    case HRAD_ERROR_ARGUMENT:
    case HRAD_ERROR_UNSUPPORTED:
      return exit_usage;
    case HRAD_ERROR_MEMORY:
      return exit_memory;
    case HRAD_ERROR_FILE:
      return exit_input_output;
    case HRAD_ERROR_FORMAT:
      return exit_checkpoint;
    case HRAD_ERROR_SCENE:
      return exit_scene;
    case HRAD_ERROR_MPI:
      return exit_mpi;
    default:
      return exit_internal;
  }
}

void check(hrad_status status) {
  if (status < 0) throw Failure(exit_code_of(status), hrad_error_message());
}

std::string fetch_text(const TextFunction& function) {
  int64_t needed = 0;
  check(function(nullptr, 0, &needed));
  std::string text(static_cast<size_t>(std::max<int64_t>(needed, 1)), '\0');
  check(function(&text[0], static_cast<int64_t>(text.size()), &needed));
  text.resize(text.find('\0'));
  return text;
}

std::vector<hrad_param> parameter_table() {
  std::vector<hrad_param> rows;
  hrad_param row{};
  row.struct_size = sizeof row;
  while (hrad_describe_param(static_cast<int64_t>(rows.size()), &row) == HRAD_OK)
    rows.push_back(row);
  return rows;
}

bool is_result_parameter(const std::string& name) {
  for (const hrad_param& row : parameter_table())
    if (name == row.name) return row.is_result != 0;
  return false;
}

Session::Session(const RunOptions& options, bool goes_on)
    : options_(options), goes_on_(goes_on), terminal_(options.verbosity()), progress_(&terminal_) {
  check(launcher::create(&solver_));
  try {
    const int32_t level = terminal_.verbosity() == Verbosity::quiet     ? HRAD_LOG_ERROR
                          : terminal_.verbosity() == Verbosity::verbose ? HRAD_LOG_INFO
                                                                        : HRAD_LOG_WARNING;
    check(hrad_set_log(solver_, log, this, level));
    check(hrad_set_progress(solver_, show_progress, this));
    set_parameters(!options_.scene_is_checkpoint());
  } catch (...) {
    hrad_destroy(&solver_);
    throw;
  }
}

Session::~Session() { hrad_destroy(&solver_); }

// Result parameters of a solution in a file come with it.
void Session::set_parameters(bool result_too) {
  for (const auto& [name, value] : options_.parameters())
    if (result_too || !is_result_parameter(name))
      check(hrad_set_text(solver_, name.c_str(), value.c_str()));
}

void Session::load() {
  const std::string& scene = options_.scene();
  if (options_.scene_is_checkpoint()) {
    check(hrad_read_checkpoint(solver_, scene.c_str()));
    agree_with_file(scene);
  } else {
    const hrad_status status = options_.scene_is_file() ? hrad_load_scene(solver_, scene.c_str())
                                                        : hrad_make_scene(solver_, scene.c_str());
    // The one thing that can be out of order here is a parameter that doesn't suit the scene.
    if (status == HRAD_ERROR_STATE) throw Failure(exit_usage, hrad_error_message());
    check(status);
  }
  signals::check();
  warn_of_diagnostics();
  if (terminal_.verbosity() == Verbosity::verbose)
    terminal_.say("loaded " + scene + ": " + std::to_string(patches()) + " patches");
}

void Session::restart(const std::string& path) {
  const hrad_status status = hrad_read_checkpoint(solver_, path.c_str());
  if (status == HRAD_ERROR_STATE) throw Failure(exit_checkpoint, hrad_error_message());
  check(status);
  agree_with_file(path);
  if (terminal_.verbosity() != Verbosity::quiet) terminal_.say("going on from " + path);
}

// The options' result parameters, now that those of the file hold.
void Session::agree_with_file(const std::string& path) {
  for (const auto& [name, value] : options_.parameters()) {
    const std::string before = parameter(name.c_str());
    const hrad_status status = hrad_set_text(solver_, name.c_str(), value.c_str());
    if (status == HRAD_ERROR_STATE)
      throw Failure(exit_usage, path + ": " + hrad_error_message(),
                    "leave the parameter out to go on with that of the file");
    check(status);
    if (!goes_on_ && is_result_parameter(name) && before != parameter(name.c_str()))
      throw Failure(exit_usage,
                    path + " was solved with " + name + " = " + before + ", not " + value,
                    "'hrad solve " + path + "' can solve it further");
  }
}

std::string Session::inspect() {
  const hrad_status status = hrad_partition(solver_);
  if (status == HRAD_ERROR_SCENE) return hrad_error_message();
  check(status);
  signals::check();
  warn_of_diagnostics();
  return "";
}

hrad_status Session::solve_until(const StopTest& stops) {
  hrad_status status = HRAD_OK;
  const auto start = std::chrono::steady_clock::now();
  {
    stops_ = stops;
    signals::Watch watch(solver_);
    status = hrad_solve(solver_);
    stops_ = nullptr;
  }
  seconds_before_ +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  terminal_.clear_line();
  // The one thing that can be out of order here is a parameter, refine=0 before the first solve.
  if (status == HRAD_ERROR_STATE) throw Failure(exit_usage, hrad_error_message());
  check(status);
  return status;
}

int Session::solve() {
  if (options_.scene_is_checkpoint() && !goes_on_) return take_as_it_is();
  const hrad_status status = solve_until(nullptr);
  signals::check();
  return conclude(status);
}

int Session::conclude(hrad_status status) {
  if (status == HRAD_STOPPED) throw Failure(exit_internal, "the solve stopped unasked");
  warn_of_diagnostics();
  if (status == HRAD_NOT_CONVERGED && terminal_.verbosity() != Verbosity::quiet)
    terminal_.say(
        "warning: not converged: the accuracy asked for was not reached (more --set "
        "max_iterations, or a larger --accuracy)");
  return exit_code_of(status);
}

// The solution of a .hrad file, finished or not.
int Session::take_as_it_is() {
  const std::string& path = options_.scene();
  int64_t leaves = 0;
  if (hrad_leaf_count(solver_, &leaves) == HRAD_ERROR_STATE)
    throw Failure(exit_checkpoint, path + " holds no solution yet: its solve was stopped before",
                  "'hrad solve " + path + "' goes on with it");
  if (stats().converged != 0) return exit_done;
  if (terminal_.verbosity() != Verbosity::quiet)
    terminal_.say("warning: " + path +
                  " holds a solution that has not converged ('hrad solve' goes on with it)");
  return exit_not_converged;
}

void Session::write_result(const std::string& path) {
  int64_t keep = 0;
  check(hrad_get_int(solver_, "checkpoint_keep", &keep));
  check(hrad_set_int(solver_, "checkpoint_keep", 0));
  const hrad_status status = hrad_write_checkpoint(solver_, path.c_str());
  const std::string message = status < 0 ? hrad_error_message() : "";
  check(hrad_set_int(solver_, "checkpoint_keep", keep));
  if (status < 0) throw Failure(exit_code_of(status), message);
}

int64_t Session::bands() const {
  int64_t bands = 0;
  check(hrad_get_int(solver_, "bands", &bands));
  return bands;
}

int64_t Session::patches() const {
  int64_t patches = 0;
  check(hrad_scene_size(solver_, &patches, nullptr));
  return patches;
}

std::string Session::parameter(const char* name) const {
  return fetch_text([&](char* text, int64_t size, int64_t* needed) {
    return hrad_get_text(solver_, name, text, size, needed);
  });
}

hrad_stats Session::stats() const {
  hrad_stats stats{};
  stats.struct_size = sizeof stats;
  check(hrad_get_stats(solver_, &stats));
  return stats;
}

std::vector<std::string> Session::diagnostics() const {
  std::vector<std::string> result;
  int64_t needed = 0;
  while (hrad_get_diagnostic(solver_, static_cast<int64_t>(result.size()), nullptr, 0, &needed) ==
         HRAD_OK) {
    const auto index = static_cast<int64_t>(result.size());
    result.push_back(fetch_text([&](char* text, int64_t size, int64_t* length) {
      return hrad_get_diagnostic(solver_, index, text, size, length);
    }));
  }
  return result;
}

// What the library found doubtful and has not said through the log.
void Session::warn_of_diagnostics() {
  if (terminal_.verbosity() == Verbosity::quiet) return;
  for (const std::string& text : diagnostics()) {
    if (std::find(warnings_.begin(), warnings_.end(), text) != warnings_.end()) continue;
    warnings_.push_back(text);
    terminal_.say("warning: " + text);
  }
}

// The two callbacks are called by C code: no exception may leave them.
void Session::log(int32_t level, const char* message, void* user) {
  auto* session = static_cast<Session*>(user);
  try {
    if (level == HRAD_LOG_WARNING) session->warnings_.emplace_back(message);
    session->terminal_.say((level == HRAD_LOG_ERROR     ? "error: "
                            : level == HRAD_LOG_WARNING ? "warning: "
                                                        : "") +
                           std::string(message));
  } catch (...) {
    // A message lost for want of memory: the call that sent it will meet the same want.
  }
}

int32_t Session::show_progress(const hrad_progress* progress, void* user) {
  auto* session = static_cast<Session*>(user);
  try {
    // A solve that was stopped and goes on is one to the user.
    hrad_progress whole = *progress;
    whole.seconds += session->seconds_before_;
    if (whole.seconds_left >= 0)
      whole.seconds_left = whole.seconds * (1 - whole.fraction) / whole.fraction;
    session->progress_.show(whole);
    if (session->stops_ && session->stops_(*progress)) return 1;
  } catch (...) {
    return 1;
  }
  return signals::pending() != 0;
}

}  // namespace hrad::cli
