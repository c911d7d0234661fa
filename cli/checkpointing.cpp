// Writing on the way, and at the end (checkpointing.h). CLI: public headers only.
#include "checkpointing.h"

#include <sys/stat.h>

#include <cstring>
#include <utility>

#include "launcher.h"
#include "numbers.h"
#include "signals.h"

namespace hrad::cli {
namespace {

// On the first of several processes, as everything here that the others could find otherwise.
bool exists(const std::string& path) {
  struct stat status {};
  return launcher::of_first(::lstat(path.c_str(), &status) == 0) != 0;
}

bool is_sound(const std::string& path) {
  return launcher::of_first(hrad_describe_checkpoint(path.c_str(), nullptr, 0, nullptr) ==
                            HRAD_OK) != 0;
}

}  // namespace

Checkpointing::Checkpointing(Session* session, CheckpointPlan plan)
    : session_(session), plan_(std::move(plan)) {}

void Checkpointing::begin() {
  if (!plan_.path.empty()) {
    if (plan_.keep) check(hrad_set_int(session_->solver(), "checkpoint_keep", *plan_.keep));
    if (plan_.resumable) check(hrad_set_int(session_->solver(), "resumable", 1));
    check(hrad_lock_checkpoint(session_->solver(), plan_.path.c_str()));
  }
  if (plan_.restart_auto)
    restart_automatically();
  else if (!plan_.restart.empty())
    session_->restart(plan_.restart);
  begun_ = true;
}

void Checkpointing::warn(const std::string& what) const {
  if (session_->terminal().verbosity() != Verbosity::quiet)
    session_->terminal().say("warning: " + what);
}

// False: the file is damaged, and that was said.
bool Checkpointing::restart_from(const std::string& path) {
  try {
    session_->restart(path);
    return true;
  } catch (const Failure& failure) {
    // What is damaged can be told from what belongs to another scene: this is a message of the
    // file.
    if (failure.code() != exit_checkpoint || is_sound(path)) throw;
    warn(failure.what());
    return false;
  }
}

void Checkpointing::restart_automatically() {
  const std::string previous = plan_.path + ".prev";
  const bool is_there = exists(plan_.path), previous_is_there = exists(previous);
  if (!is_there && !previous_is_there) return;
  if (is_there && restart_from(plan_.path)) {
    const hrad_stats stats = session_->stats();
    sweeps_written_ = stats.iterations;
    converged_written_ = stats.converged;
    return;
  }
  // What is damaged must not take the place of what was kept.
  if (is_there) check(hrad_set_int(session_->solver(), "checkpoint_keep", 0));
  if (previous_is_there && restart_from(previous)) {
    warn(plan_.path + (is_there ? " is damaged" : " is missing") + ": going on from the older " +
         previous);
    return;
  }
  throw Failure(exit_checkpoint,
                plan_.path + (is_there ? " is damaged" : " is missing") + " and " + previous +
                    (previous_is_there ? " is damaged" : " is missing"),
                "remove what is damaged to begin anew");
}

bool Checkpointing::out_of_time() const {
  return plan_.time_limit > 0 &&
         std::chrono::duration<double>(Clock::now() - start_).count() >= plan_.time_limit;
}

// Asked with every progress of the first process: writes when it is time, and the solve goes on.
// Several processes write together, which they can't from here: the solve pauses for it.
bool Checkpointing::stops(const hrad_progress& progress) {
  if (out_of_time()) return true;
  if (plan_.path.empty()) return false;
  due_ =
      signals::take_checkpoint_request() || due_ ||
      std::chrono::duration<double>(Clock::now() - last_written_).count() >= plan_.interval_seconds;
  if (!launcher::several()) {
    if (due_) write_on_the_way();
    return false;
  }
  pauses_ = pause_.is_allowed(progress) && due_;
  if (pauses_) pause_.begin(progress);
  return pauses_;
}

int Checkpointing::solve() {
  hrad_status status = HRAD_OK;
  for (;;) {
    pauses_ = false;
    pause_.resume();
    status = session_->solve_until([this](const hrad_progress& p) { return stops(p); });
    signals::check();
    if (status != HRAD_STOPPED) break;
    if (launcher::of_first(out_of_time()) != 0) end_with_checkpoint("the time limit is reached");
    if (launcher::of_first(pauses_) == 0) break;
    write_on_the_way();
  }
  if (status != HRAD_STOPPED && !plan_.path.empty() && has_news()) {
    try {
      write();
    } catch (const Failure& failure) {
      failure_at_end_ = failure;
    }
  }
  return session_->conclude(status);
}

void Checkpointing::check_end() const {
  if (failure_at_end_) throw Failure(*failure_at_end_);
}

// A solve that did nothing leaves the file as it is.
bool Checkpointing::has_news() const {
  const hrad_stats stats = session_->stats();
  return launcher::of_first(stats.iterations != sweeps_written_ ||
                            stats.converged != converged_written_) != 0;
}

void Checkpointing::write() {
  check(hrad_write_checkpoint(session_->solver(), plan_.path.c_str()));
  const hrad_stats stats = session_->stats();
  sweeps_written_ = stats.iterations;
  converged_written_ = stats.converged;
}

// A disk that is full for a while ends no solve: the old checkpoint is whole, and the next one will
// be tried in its time.
void Checkpointing::write_on_the_way() {
  const hrad_status status = hrad_write_checkpoint(session_->solver(), plan_.path.c_str());
  // While there is nothing to keep, the file stays as it is.
  if (status < 0 && status != HRAD_ERROR_STATE)
    warn(std::string("no checkpoint was written: ") + hrad_error_message());
  else if (status == HRAD_OK && session_->terminal().verbosity() == Verbosity::verbose)
    session_->terminal().say("wrote " + plan_.path);
  if (status == HRAD_OK) sweeps_written_ = -1;
  last_written_ = Clock::now();
  due_ = false;
}

void Checkpointing::end_with_checkpoint(const std::string& why) {
  // What was not begun is in the file already, or in none.
  if (begun_) write();
  throw Failure(exit_stopped, why + (begun_ ? ": " + plan_.path + " has the solve so far" : ""),
                "the same command goes on with --restart auto");
}

void Checkpointing::end_by_signal(int signal) {
  if (plan_.path.empty()) return;
  end_with_checkpoint(std::string("stopped: ") + ::strsignal(signal));
}

}  // namespace hrad::cli
