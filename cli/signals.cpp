// Signals (signals.h). A handler may run on any thread, the library's too; it does only what is
// allowed there: lock-free atomics, hrad_request_stop, _exit. CLI: public headers only.
#include "signals.h"

#include <sched.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>

#include "exit_code.h"
#include "launcher.h"

namespace hrad::cli::signals {
namespace {

std::atomic<int> first_signal{0};
std::atomic<int> urgent_signals{0};  // SIGINT and SIGTERM so far
std::atomic<int> handlers_running{0};
std::atomic<int> checkpoints_wanted{0};
std::atomic<hrad_solver*> watched{nullptr};
bool line_may_stand = false;  // stderr is a terminal: a progress line may stand there

static_assert(std::atomic<int>::is_always_lock_free &&
                  std::atomic<hrad_solver*>::is_always_lock_free,
              "a signal handler needs them");

void handle(int number) {
  handlers_running.fetch_add(1);
  if (number != SIGUSR1 && urgent_signals.fetch_add(1) > 0) {
    const ssize_t written = line_may_stand ? ::write(STDERR_FILENO, "\n", 1) : 0;
    static_cast<void>(written);  // there is nowhere to complain
    ::_exit(exit_signal + number);
  }
  int none = 0;
  first_signal.compare_exchange_strong(none, number);
  hrad_request_stop(watched.load());
  handlers_running.fetch_sub(1);
}

void note_checkpoint(int) { checkpoints_wanted.store(1); }

}  // namespace

void install() {
  line_may_stand = ::isatty(STDERR_FILENO) != 0;
  struct sigaction action {};
  action.sa_handler = handle;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (int number : {SIGINT, SIGTERM, SIGUSR1}) ::sigaction(number, &action, nullptr);
  // It must not end a solve where there is no checkpoint to write.
  action.sa_handler = note_checkpoint;
  ::sigaction(SIGUSR2, &action, nullptr);
  // Writing beyond the limit on file sizes then fails with a reason, as on a full disk.
  action.sa_handler = SIG_IGN;
  ::sigaction(SIGXFSZ, &action, nullptr);
}

int pending() { return first_signal.load(); }

bool take_checkpoint_request() { return checkpoints_wanted.exchange(0) != 0; }

void check() {
  const auto number = static_cast<int>(launcher::largest(pending()));
  if (number != 0) throw Interrupted{number};
}

Watch::Watch(hrad_solver* solver) {
  watched.store(solver);
  // A signal that came before would otherwise be seen only after the whole solve.
  if (pending() != 0) hrad_request_stop(solver);
}

Watch::~Watch() {
  watched.store(nullptr);
  // A handler on another thread may still hold the solver.
  while (handlers_running.load() != 0) ::sched_yield();
}

}  // namespace hrad::cli::signals
