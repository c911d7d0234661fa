// hrad.h, section "solve". Floor 9 (api).
#include "api/arguments.h"
#include "api/guard.h"

namespace {

// While the user's function is asked.
class Reporting {
 public:
  explicit Reporting(hrad_solver* handle) : handle_(handle) {
    handle_->reporting_thread = std::this_thread::get_id();
    handle_->reporting = true;
  }
  ~Reporting() { handle_->reporting = false; }
  Reporting(const Reporting&) = delete;
  Reporting& operator=(const Reporting&) = delete;

 private:
  hrad_solver* handle_;
};

// Hands progress to the user's function: true to go on. A function that throws stops the solve.
bool forward_progress(hrad_solver* handle, const hrad::Progress& from) {
  hrad_progress progress = {};
  progress.struct_size = sizeof progress;
  progress.stage = from.stage;
  progress.iteration = from.iteration;
  progress.fraction = from.fraction;
  progress.seconds = from.seconds;
  progress.seconds_left = from.seconds_left;
  const Reporting reporting(handle);
  try {
    return handle->progress(&progress, handle->progress_user) == 0;
  } catch (...) {
    handle->callback_that_threw = "progress";
    return false;
  }
}

// While hrad_solve is at work.
class Solving {
 public:
  explicit Solving(hrad_solver* handle) : handle_(handle) {
    handle_->solving = true;
    handle_->callback_that_threw = nullptr;
  }
  ~Solving() { handle_->solving = false; }
  Solving(const Solving&) = delete;
  Solving& operator=(const Solving&) = delete;

 private:
  hrad_solver* handle_;
};

}  // namespace

hrad_status hrad_set_progress(hrad_solver* solver, hrad_progress_function function, void* user) {
  return hrad::api::guarded(solver, [&](hrad::Solver& inside) {
    std::function<bool(const hrad::Progress&)> sink;
    if (function)
      sink = [solver](const hrad::Progress& from) { return forward_progress(solver, from); };
    inside.set_progress(std::move(sink));
    solver->progress = function;
    solver->progress_user = user;
  });
}

hrad_status hrad_solve(hrad_solver* solver) {
  return hrad::api::collective(solver, [&](hrad::Solver& inside) {
    const Solving solving(solver);
    const hrad::Status status = inside.solve();
    if (solver->callback_that_threw)
      hrad::fail(hrad::Status::internal,
                 "the %s function threw an exception, which it must not: the solve was stopped and "
                 "can go on",
                 solver->callback_that_threw);
    return status;
  });
}

void hrad_request_stop(hrad_solver* solver) {
  if (solver) solver->solver.request_stop();
}

hrad_status hrad_get_stats(const hrad_solver* solver, hrad_stats* stats) {
  return hrad::api::collective(solver, [&](const hrad::Solver& inside) {
    hrad::api::require(stats, "the place for the statistics");
    hrad::api::require_struct_size(stats->struct_size, "hrad_stats");
    const hrad::Stats from = inside.stats();
    hrad_stats full = {};
    full.converged = from.converged ? 1 : 0;
    full.ranks = from.ranks;
    full.threads = from.threads;
    full.rounds = from.rounds;
    full.up_axis = from.up_axis;
    full.iterations = from.iterations;
    full.patches = from.patches;
    full.elements = from.elements;
    full.leaves = from.leaves;
    full.links = from.links;
    full.rays = from.rays;
    full.pairs = from.pairs;
    full.area = from.area;
    full.sealed_area = from.sealed_area;
    full.back_share = from.back_share;
    full.error_estimate = from.error_estimate;
    full.error_standard_error = from.error_standard_error;
    full.seconds_load = from.seconds_load;
    full.seconds_initial = from.seconds_initial;
    full.seconds_linking = from.seconds_linking;
    full.seconds_iterative = from.seconds_iterative;
    full.seconds_output = from.seconds_output;
    full.cpu_seconds = from.cpu_seconds;
    full.memory_peak_bytes = from.memory_peak_bytes;
    full.link_bytes = from.link_bytes;
    full.node_bytes = from.node_bytes;
    for (int kind = 0; kind < 3; ++kind) {
      full.messages[kind] = from.messages[kind];
      full.message_bytes[kind] = from.message_bytes[kind];
    }
    full.swept_links = from.swept_links;
    hrad::api::copy_struct_out(full, stats);
  });
}

hrad_status hrad_state_hash(const hrad_solver* solver, uint64_t* hash) {
  return hrad::api::collective(solver, [&](const hrad::Solver& inside) {
    hrad::api::require(hash, "the place for the hash");
    *hash = inside.state_hash();
  });
}
