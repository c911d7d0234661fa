// What stands behind the opaque handle of hrad.h, and the guard of every entry: exceptions become
// statuses and a message of this thread, calls into a solver that is busy are refused. Floor 9
// (api).
#pragma once

#include <atomic>
#include <thread>
#include <type_traits>

#include "base/error.h"
#include "hrad/hrad.h"
#include "solver/solver.h"

struct hrad_solver {
  hrad::Solver solver;

  // Some entry is at work on this solver: a further one comes from a callback or another thread.
  mutable std::atomic<bool> busy{false};

  hrad_log_function log = nullptr;
  void* log_user = nullptr;
  hrad_progress_function progress = nullptr;
  void* progress_user = nullptr;

  // hrad_solve is at work: a callback that throws stops it at the next safe point.
  bool solving = false;
  // It is waiting for the progress function, on the thread that runs that.
  std::atomic<bool> reporting{false};
  std::atomic<std::thread::id> reporting_thread{};
  const char* callback_that_threw = nullptr;
};

namespace hrad {
namespace api {

// This thread's last failure; the only state outside the solvers.
void remember_error(const char* message) noexcept;
const char* last_error() noexcept;

// To be called in a handler: remembers what the exception says and gives its status.
hrad_status status_of_current_exception() noexcept;

// Marks a solver as busy while it lives; STATE if it is so already.
class Entry {
 public:
  explicit Entry(const hrad_solver& solver) : solver_(solver) {
    if (solver_.busy.exchange(true, std::memory_order_acquire))
      fail(Status::state,
           "the solver is at work in another call, whose callback or another thread made this one: "
           "wait until it returns (only hrad_request_stop may be called meanwhile)");
  }
  ~Entry() { solver_.busy.store(false, std::memory_order_release); }
  Entry(const Entry&) = delete;
  Entry& operator=(const Entry&) = delete;

 private:
  const hrad_solver& solver_;
};

// Runs a body that needs no solver; it returns nothing or a Status.
template <class Body>
hrad_status guarded(const Body& body) noexcept {
  try {
    if constexpr (std::is_void_v<decltype(body())>) {
      body();
      return HRAD_OK;
    } else {
      return static_cast<hrad_status>(body());
    }
  } catch (...) {
    return status_of_current_exception();
  }
}

// Runs a body on a solver: body(handle->solver), with the constness of the handle.
template <class Handle, class Body>
hrad_status guarded(Handle* handle, const Body& body) noexcept {
  return guarded([&] {
    if (!handle) fail(Status::argument, "the solver is NULL: make one with hrad_create");
    const Entry entry(*handle);
    return body(handle->solver);
  });
}

}  // namespace api
}  // namespace hrad
