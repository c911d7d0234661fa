// Finding the launcher, and what the processes tell each other (launcher.h). The only place of the
// tool that knows MPI; without it every process stands alone. CLI: public headers only.
#include "launcher.h"

#include <cstdlib>

#include "exit_code.h"
#include "numbers.h"

#ifdef HRAD_CLI_MPI
#include "hrad/hrad_mpi.h"
#endif

namespace hrad::cli::launcher {
namespace {

// What launchers tell their processes. Inside a job of Slurm but outside srun there is no step, or
// one of a single task. PMIX_RANK comes without a number of processes.
constexpr struct {
  const char* count;
  const char* rank;
} known_variables[] = {
    {"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},  // mpirun of Open MPI
    {"PMI_SIZE", "PMI_RANK"},                          // that of MPICH, Intel MPI; srun --mpi=pmi2
    {"SLURM_STEP_NUM_TASKS", "SLURM_PROCID"},          // srun
    {nullptr, "PMIX_RANK"},                            // prterun
};

int64_t number_of(const char* variable, int64_t otherwise) {
  const char* text = variable != nullptr ? std::getenv(variable) : nullptr;
  int64_t number = 0;
  return text != nullptr && read_integer(text, &number) ? number : otherwise;
}

struct Place {
  int64_t count = 1, rank = 0;
  bool is_launched = false;  // beside others, as far as one can tell
};

Place place_of_this_process() {
  for (const auto& variables : known_variables) {
    const int64_t count = number_of(variables.count, 0), rank = number_of(variables.rank, -1);
    if (count >= 1) return {count, rank < 0 ? 0 : rank, count > 1};
    if (variables.count == nullptr && rank >= 0) return {1, rank, true};
  }
  return {};
}

enum class State { unknown, by_itself, together, left_out };
State state = State::unknown;

[[noreturn]] void fail(const std::string& message, const std::string& hint = {}) {
  throw Failure(exit_mpi, message, hint);
}

#ifdef HRAD_CLI_MPI

MPI_Comm all = MPI_COMM_NULL;
int own_rank = 0, processes = 1;
bool mpi_runs = false;

void check_mpi(int code) {
  if (code == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING + 1] = "";
  int length = 0;
  MPI_Error_string(code, text, &length);
  fail(std::string("MPI failed: ") + text);
}

std::string name_of_mpi() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING + 1] = "";
  int length = 0;
  MPI_Get_library_version(text, &length);
  const std::string name(text);
  return name.substr(0, name.find_first_of(",\n"));
}

void start_mpi(const Place& place) {
  int level = MPI_THREAD_SINGLE;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level) != MPI_SUCCESS)
    fail("MPI can't be started");
  mpi_runs = true;
  check_mpi(MPI_Comm_dup(MPI_COMM_WORLD, &all));
  check_mpi(MPI_Comm_set_errhandler(all, MPI_ERRORS_RETURN));
  check_mpi(MPI_Comm_rank(all, &own_rank));
  check_mpi(MPI_Comm_size(all, &processes));
  // A launcher of another MPI: every process believes itself to be the only one.
  if (processes == 1 && place.count > 1)
    fail(
        "started as one of " + std::to_string(place.count) + " processes, but " + name_of_mpi() +
            " knows of no other: all would do the same work",
        "use its own mpirun, or srun with the --mpi that fits it; or say --mpi off if that is what "
        "you want");
  state = State::together;
}

void broadcast(void* data, size_t size) {
  constexpr size_t most = size_t{1} << 30;  // what a count can hold
  for (size_t first = 0; first < size; first += most)
    check_mpi(MPI_Bcast(static_cast<char*>(data) + first,
                        static_cast<int>(size - first < most ? size - first : most), MPI_BYTE, 0,
                        all));
}

#else

constexpr int own_rank = 0, processes = 1;

void start_mpi(const Place&) {}
void broadcast(void*, size_t) {}

#endif

// How the first one's work has ended.
struct Outcome {
  int64_t failed = 0, code = 0, signal = 0;
};

}  // namespace

bool start(Choice choice, Work work) {
  const Place place = place_of_this_process();
#ifndef HRAD_CLI_MPI
  if (choice == Choice::on) fail("--mpi on: this build has no MPI");
#endif
  if (work == Work::of_the_first) {
    state = choice != Choice::off && place.rank > 0 ? State::left_out : State::by_itself;
    return state == State::by_itself;
  }
  if (choice == Choice::off || (choice == Choice::automatic && !place.is_launched)) {
    state = State::by_itself;
    return true;
  }
#ifndef HRAD_CLI_MPI
  fail("started as one of " +
           (place.count > 1 ? std::to_string(place.count) : std::string("several")) +
           " processes, but this build has no MPI: all would do the same work",
       "start one process, or say --mpi off if that is what you want");
#endif
  start_mpi(place);
  return true;
}

bool several() { return state == State::together && processes > 1; }

bool speaks() {
  switch (state) {
    case State::by_itself:
      return true;
    case State::together:
      return own_rank == 0;
    case State::left_out:
      return false;
    default:
      return place_of_this_process().rank == 0;
  }
}

void on_first(const std::function<void()>& work) {
  if (state != State::together) {
    if (speaks()) work();
    return;
  }
  Outcome outcome;
  std::string message, hint;
  if (own_rank == 0) {
    try {
      work();
    } catch (const Failure& failure) {
      outcome.failed = 1;
      outcome.code = failure.code();
      message = failure.what();
      hint = failure.hint();
    } catch (const Interrupted& interrupted) {
      outcome.signal = interrupted.signal;
    }
  }
  broadcast(&outcome, sizeof outcome);
  if (outcome.signal != 0) throw Interrupted{static_cast<int>(outcome.signal)};
  if (outcome.failed == 0) return;
  share_of_first(&message);
  share_of_first(&hint);
  throw Failure(static_cast<int>(outcome.code), message, hint);
}

int64_t of_first(int64_t mine) {
  if (state == State::together) broadcast(&mine, sizeof mine);
  return mine;
}

void share_of_first(std::string* text) {
  if (state != State::together) return;
  text->resize(static_cast<size_t>(of_first(static_cast<int64_t>(text->size()))));
  broadcast(&(*text)[0], text->size());
}

#ifdef HRAD_CLI_MPI

int64_t largest(int64_t mine) {
  if (state == State::together)
    check_mpi(MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_INT64_T, MPI_MAX, all));
  return mine;
}

hrad_status create(hrad_solver** solver) {
  return state == State::together ? hrad_create_mpi(all, solver) : hrad_create(solver);
}

int finish(int code) {
  if (!mpi_runs) return code;
  try {
    code = static_cast<int>(largest(code));
  } catch (const Failure&) {
    return finish_alone(exit_mpi);
  }
  if (all != MPI_COMM_NULL) MPI_Comm_free(&all);
  MPI_Finalize();
  mpi_runs = false;
  return code;
}

int finish_alone(int code) {
  if (mpi_runs && state == State::together) MPI_Abort(MPI_COMM_WORLD, code);
  return finish(code);
}

#else

int64_t largest(int64_t mine) { return mine; }
hrad_status create(hrad_solver** solver) { return hrad_create(solver); }
int finish(int code) { return code; }
int finish_alone(int code) { return code; }

#endif

}  // namespace hrad::cli::launcher
