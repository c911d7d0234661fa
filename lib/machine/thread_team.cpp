// The pool's workers and the loop in which they take tasks from a shared counter (paper, Section
// 3.2: a patch is assigned on demand to a free thread). Workers sleep between loops and never spin.
// Floor 2 (machine).
#include "machine/thread_team.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "base/error.h"
#include "machine/work_observer.h"
#if defined(__linux__)
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#endif

namespace hrad {
namespace {

constexpr size_t kCacheLine = 64;  // bytes; counters of different use stay apart
constexpr std::chrono::milliseconds kReportPause{100};  // between reports while only others work

// While it lives, threads started here let the host's asynchronous signals pass by: their handlers
// run on the host's own threads. Faults and profiling stay with the thread that causes them.
class SignalsHeldBack {
 public:
#if defined(__linux__)
  SignalsHeldBack() {
    sigset_t held;
    sigfillset(&held);
    for (int own : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGABRT, SIGSYS, SIGPROF})
      sigdelset(&held, own);
    changed_ = pthread_sigmask(SIG_BLOCK, &held, &before_) == 0;
  }
  ~SignalsHeldBack() {
    if (changed_) pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

 private:
  sigset_t before_;
  bool changed_ = false;
#endif
};

// Binding is a wish: where the system refuses it, the thread runs anywhere.
void bind_this_thread(const std::vector<int>& processors) {
#if defined(__linux__)
  int highest = -1;
  for (int processor : processors) highest = processor > highest ? processor : highest;
  if (highest < 0) return;
  const size_t count = static_cast<size_t>(highest) + 1;
  cpu_set_t* set = CPU_ALLOC(count);
  if (!set) return;
  const size_t bytes = CPU_ALLOC_SIZE(count);
  CPU_ZERO_S(bytes, set);
  for (int processor : processors)
    if (processor >= 0) CPU_SET_S(static_cast<size_t>(processor), bytes, set);
  pthread_setaffinity_np(pthread_self(), bytes, set);
  CPU_FREE(set);
#else
  (void)processors;
#endif
}

// One for_each. Taking a task and looking whether to stop is one operation on one counter: every
// task below a taken one has been taken too, and is finished. So the lowest task that throws is
// always found, whatever the threads' timing.
class Loop {
 public:
  Loop(int64_t count, const std::function<void(int64_t, int)>& body) : count_(count), body_(body) {}

  // Takes and runs one task; false when none is left.
  bool run_one(int worker) {
    const int64_t task = next_.fetch_add(1);
    if (task >= count_) return false;
    try {
      body_(task, worker);
    } catch (...) {
      record(task, std::current_exception());
      stop();
    }
    finished_.fetch_add(1);
    return true;
  }

  // No task is taken any more. A counter past the end stays past the end.
  void stop() { next_.store(count_); }

  int64_t finished() const { return finished_.load(); }

  // Keeps the exception of the lowest task. between's counts as that of a task past the end.
  void record(int64_t task, std::exception_ptr exception) {
    std::lock_guard<std::mutex> lock(mutex_);
    if (exception_ && failed_task_ <= task) return;
    failed_task_ = task;
    exception_ = std::move(exception);
  }
  void record_between(std::exception_ptr exception) { record(count_, std::move(exception)); }

  // Once all workers have left.
  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  const int64_t count_;
  const std::function<void(int64_t, int)>& body_;
  alignas(kCacheLine) std::atomic<int64_t> next_{0};
  alignas(kCacheLine) std::atomic<int64_t> finished_{0};
  alignas(kCacheLine) std::mutex mutex_;
  int64_t failed_task_ = 0;
  std::exception_ptr exception_;
};

}  // namespace

struct ThreadTeam::State {
  std::vector<std::vector<int>> binding;
  std::vector<std::thread> threads;  // workers 1, 2, ...
  std::atomic<bool> busy{false};     // a for_each is under way

  std::mutex mutex;  // guards what follows
  std::condition_variable opened, emptied;
  Loop* loop = nullptr;  // the loop that workers may enter
  uint64_t loop_number = 0;
  int inside = 0;  // workers in the loop
  bool quit = false;

  ~State() {
    {
      std::lock_guard<std::mutex> lock(mutex);
      quit = true;
    }
    opened.notify_all();
    for (std::thread& thread : threads) thread.join();
  }

  // A worker's life. One that wakes when a loop is over already goes back to sleep, and nobody
  // waits for it.
  void work(int worker) {
    if (static_cast<size_t>(worker) < binding.size()) bind_this_thread(binding[worker]);
    uint64_t last = 0;
    std::unique_lock<std::mutex> lock(mutex);
    for (;;) {
      opened.wait(lock, [&] { return quit || (loop && loop_number != last); });
      if (quit) return;
      last = loop_number;
      Loop* entered = loop;
      ++inside;
      lock.unlock();
      while (entered->run_one(worker)) {
      }
      lock.lock();
      if (--inside == 0) emptied.notify_one();
    }
  }

  void open(Loop* opened_loop) {
    {
      std::lock_guard<std::mutex> lock(mutex);
      loop = opened_loop;
      ++loop_number;
    }
    opened.notify_all();
  }

  // Lets no further worker in and waits until all have left; report() now and then.
  template <class Report>
  void close(const Report& report) {
    std::unique_lock<std::mutex> lock(mutex);
    loop = nullptr;
    while (!emptied.wait_for(lock, kReportPause, [&] { return inside == 0; })) {
      lock.unlock();
      report();
      lock.lock();
    }
  }
};

ThreadTeam::ThreadTeam(int threads, std::vector<std::vector<int>> binding)
    : state_(std::make_unique<State>()) {
  if (threads < 1) fail(Status::argument, "a thread team needs at least 1 thread, not %d", threads);
  State* state = state_.get();
  state->binding = std::move(binding);
  state->threads.reserve(static_cast<size_t>(threads) - 1);
  const SignalsHeldBack held;
  try {
    for (int worker = 1; worker < threads; ++worker)
      state->threads.emplace_back([state, worker] { state->work(worker); });
  } catch (const std::system_error& e) {
    const int started = size();
    state_.reset();
    fail(Status::memory, "only %d of %d threads could be started: %s; use fewer threads", started,
         threads, e.what());
  }
}

ThreadTeam::~ThreadTeam() = default;

int ThreadTeam::size() const { return static_cast<int>(state_->threads.size()) + 1; }

bool ThreadTeam::for_each(int64_t count, const std::function<void(int64_t task, int worker)>& body,
                          const std::function<bool(int64_t done)>& between) {
  if (!observer_) return run(count, body, between);
  observer_->loop_begins(count);
  const bool going_on = run(
      count,
      [&](int64_t task, int worker) {
        body(task, worker);
        observer_->task_ends(task, worker);
      },
      between);
  observer_->loop_ends();
  return going_on;
}

bool ThreadTeam::run(int64_t count, const std::function<void(int64_t task, int worker)>& body,
                     const std::function<bool(int64_t done)>& between) {
  if (state_->busy.exchange(true))
    fail(Status::internal, "a loop was started on a thread team that is running one");
  Loop loop(count, body);
  bool go_on = true;
  int64_t reported = -1;  // of finished tasks
  const auto report = [&] {
    if (!between || !go_on) return;
    reported = loop.finished();
    try {
      go_on = between(reported);
    } catch (...) {
      loop.record_between(std::current_exception());
      go_on = false;
    }
    if (!go_on) loop.stop();
  };

  const bool shared = count > 1 && !state_->threads.empty();
  if (shared) state_->open(&loop);
  while (loop.run_one(0)) report();
  if (shared) state_->close(report);
  // Others may have finished the last ones: all are told of, as one thread tells.
  if (count > 0 && reported < loop.finished()) report();
  state_->busy.store(false);
  loop.rethrow();
  return go_on;
}

}  // namespace hrad
