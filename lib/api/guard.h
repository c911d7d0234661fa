// What stands behind the opaque handle of hrad.h, and the guard of every entry: exceptions become
// statuses and a message of this thread, calls into a solver that is busy are refused. Floor 9
// (api).
#pragma once

#include <atomic>
#include <memory>
#include <thread>
#include <type_traits>
#include <utility>

#include "base/error.h"
#include "hrad/hrad.h"
#include "solver/solver.h"

struct hrad_solver {
  hrad_solver() = default;
  explicit hrad_solver(std::shared_ptr<hrad::Comm> comm) : solver(std::move(comm)) {}

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

// Brings all ranks to one outcome: ends when every rank's body has, and if one fails, all of them
// fail with the same status and message.
template <class Body>
auto agreed(Comm& comm, const Body& body) -> decltype(body()) {
  try {
    if constexpr (std::is_void_v<decltype(body())>) {
      body();
      comm.all_go_on();
    } else {
      const auto result = body();
      comm.all_go_on();
      return result;
    }
  } catch (const AgreedError&) {
    throw;
  } catch (...) {
    if (comm.alone()) throw;
    const hrad_status status = status_of_current_exception();
    comm.fail_all(static_cast<Status>(status), last_error());
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

// The same for a collective function.
template <class Handle, class Body>
hrad_status collective(Handle* handle, const Body& body) noexcept {
  return guarded(handle,
                 [&](auto& solver) { return agreed(solver.comm(), [&] { return body(solver); }); });
}

}  // namespace api
}  // namespace hrad
