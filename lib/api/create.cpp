// hrad.h, sections "status", "log" and "create". Floor 9 (api).
#include <memory>
#include <string>

#include "api/arguments.h"
#include "api/create_over.h"
#include "api/guard.h"

namespace {

#define HRAD_TEXT_OF(number) #number
#define HRAD_VERSION_TEXT(major, minor, patch) \
  HRAD_TEXT_OF(major) "." HRAD_TEXT_OF(minor) "." HRAD_TEXT_OF(patch)

// Hands a message to the user's function. An exception of that function must not fly through the
// library in mid-solve: the solve stops at its next safe point and reports it; elsewhere the call
// fails here, where it can take everything back.
void forward_log(int32_t level, const char* message, void* user) {
  auto* handle = static_cast<hrad_solver*>(user);
  try {
    handle->log(level, message, handle->log_user);
  } catch (...) {
    if (!handle->solving)
      hrad::fail(hrad::Status::internal, "the log function threw an exception: it must not");
    handle->callback_that_threw = "log";
    handle->solver.request_stop();
  }
}

}  // namespace

int32_t hrad_version(void) {
  return HRAD_VERSION_MAJOR * 10000 + HRAD_VERSION_MINOR * 100 + HRAD_VERSION_PATCH;
}

const char* hrad_version_text(void) {
  return HRAD_VERSION_TEXT(HRAD_VERSION_MAJOR, HRAD_VERSION_MINOR, HRAD_VERSION_PATCH);
}

const char* hrad_status_name(hrad_status status) {
  switch (status) {
    case HRAD_OK:
      return "HRAD_OK";
    case HRAD_NOT_CONVERGED:
      return "HRAD_NOT_CONVERGED";
    case HRAD_STOPPED:
      return "HRAD_STOPPED";
    case HRAD_ERROR_ARGUMENT:
      return "HRAD_ERROR_ARGUMENT";
    case HRAD_ERROR_STATE:
      return "HRAD_ERROR_STATE";
    case HRAD_ERROR_MEMORY:
      return "HRAD_ERROR_MEMORY";
    case HRAD_ERROR_FILE:
      return "HRAD_ERROR_FILE";
    case HRAD_ERROR_FORMAT:
      return "HRAD_ERROR_FORMAT";
    case HRAD_ERROR_SCENE:
      return "HRAD_ERROR_SCENE";
    case HRAD_ERROR_MPI:
      return "HRAD_ERROR_MPI";
    case HRAD_ERROR_UNSUPPORTED:
      return "HRAD_ERROR_UNSUPPORTED";
    case HRAD_ERROR_INTERNAL:
      return "HRAD_ERROR_INTERNAL";
    default:
      return "HRAD_UNKNOWN";
  }
}

const char* hrad_error_message(void) { return hrad::api::last_error(); }

hrad_status hrad_set_log(hrad_solver* solver, hrad_log_function function, void* user,
                         int32_t level) {
  return hrad::api::guarded(solver, [&](hrad::Solver& inside) {
    if (level < HRAD_LOG_ERROR || level > HRAD_LOG_DEBUG)
      hrad::fail(hrad::Status::argument, "the log level is %d: it must be from %d to %d",
                 static_cast<int>(level), HRAD_LOG_ERROR, HRAD_LOG_DEBUG);
    solver->log = function;
    solver->log_user = user;
    inside.log().function = function ? forward_log : nullptr;
    inside.log().user = solver;
    inside.log().level = level;
  });
}

hrad_status hrad_create(hrad_solver** solver) {
  return hrad::api::guarded([&] {
    hrad::api::require(solver, "the place for the new solver");
    *solver = new hrad_solver;
  });
}

hrad_status hrad_create_over(hrad_comm_maker make, const void* host, hrad_solver** solver) {
  return hrad::api::guarded([&] {
    // Should there be no room for the solver, the others are still to be told.
    const std::shared_ptr<hrad::Comm> owned(make(host));
    std::unique_ptr<hrad_solver> made;
    hrad::api::agreed(*owned, [&] {
      hrad::api::require(solver, "the place for the new solver");
      made = std::make_unique<hrad_solver>(owned);
    });
    *solver = made.release();
  });
}

void hrad_destroy(hrad_solver** solver) {
  if (!solver || !*solver) return;
  // Freeing a solver under its own feet would end the program: a call from a callback does nothing.
  if ((*solver)->busy.load(std::memory_order_acquire)) {
    hrad::api::remember_error(
        "the solver is at work and can't be destroyed: call hrad_destroy after the call returned");
    return;
  }
  delete *solver;
  *solver = nullptr;
}
