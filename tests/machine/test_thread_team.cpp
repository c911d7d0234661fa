// The thread pool: every task once, by index, whatever the threads; which exception wins; stopping.
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <future>
#include <thread>

#include "base/error.h"
#include "machine/thread_team.h"
#include "machine/work_observer.h"
#include "support/check.h"
#include "support/sanitized.h"

using hrad::Error;
using hrad::Status;
using hrad::ThreadTeam;

namespace {

constexpr int kTeamSizes[] = {1, 2, 3, 4, 16};

// Every task runs exactly once, its result lies at its index, and workers are numbered 0..size-1.
void every_task_once() {
  for (int size : kTeamSizes) {
    ThreadTeam team(size);
    CHECK_EQUAL(team.size(), size);
    for (int64_t count : {1, 2, 3, 7, 1000}) {
      std::vector<int64_t> result(count, -1);
      std::vector<std::atomic<int>> runs(count);
      std::atomic<bool> worker_in_range{true};
      CHECK(team.for_each(count, [&](int64_t task, int worker) {
        ++runs[task];
        result[task] = task * task;
        if (worker < 0 || worker >= size) worker_in_range = false;
      }));
      CHECK(worker_in_range);
      for (int64_t task = 0; task < count; ++task) {
        CHECK_EQUAL(runs[task].load(), 1);
        CHECK_EQUAL(result[task], task * task);
      }
    }
  }
}

void no_task() {
  for (int size : kTeamSizes) {
    ThreadTeam team(size);
    int calls = 0;
    CHECK(team.for_each(
        0, [&](int64_t, int) { ++calls; }, [&](int64_t) { return ++calls, false; }));
    CHECK_EQUAL(calls, 0);
  }
}

// One worker takes the tasks in ascending order on the calling thread.
void one_thread_is_a_loop() {
  ThreadTeam team(1);
  std::vector<int64_t> order;
  std::vector<int64_t> reported;
  const std::thread::id caller = std::this_thread::get_id();
  CHECK(team.for_each(
      4,
      [&](int64_t task, int worker) {
        CHECK_EQUAL(worker, 0);
        CHECK(std::this_thread::get_id() == caller);
        order.push_back(task);
      },
      [&](int64_t done) { return reported.push_back(done), true; }));
  CHECK(order == (std::vector<int64_t>{0, 1, 2, 3}));
  CHECK(reported == (std::vector<int64_t>{1, 2, 3, 4}));
}

// Two tasks that wait for each other can only end on two threads at once; the caller is one.
void workers_run_at_once() {
  ThreadTeam team(2);
  std::promise<void> arrived[2];
  std::shared_future<void> seen[2] = {arrived[0].get_future().share(),
                                      arrived[1].get_future().share()};
  int worker_of[2] = {-1, -1};
  CHECK(team.for_each(2, [&](int64_t task, int worker) {
    worker_of[task] = worker;
    arrived[task].set_value();
    if (seen[1 - task].wait_for(std::chrono::seconds(60)) != std::future_status::ready)
      throw std::runtime_error("the other task never started");
  }));
  CHECK(worker_of[0] != worker_of[1]);
  CHECK(worker_of[0] + worker_of[1] == 1);
}

// A worker is one thread: its number may index scratch space without a lock.
void a_worker_is_one_thread() {
  ThreadTeam team(4);
  std::vector<int64_t> sum(4, 0);
  for (int pass = 0; pass < 50; ++pass)
    team.for_each(100, [&](int64_t task, int worker) { sum[worker] += task; });
  CHECK_EQUAL(sum[0] + sum[1] + sum[2] + sum[3], int64_t{50 * 99 * 50});
}

// Whatever the timing, the lowest task that throws is the one reported, and the team lives on.
void lowest_exception_wins() {
  for (int size : kTeamSizes) {
    ThreadTeam team(size);
    for (int pass = 0; pass < 100; ++pass) {
      std::atomic<int> calls{0};
      CHECK_FAILS(team.for_each(200,
                                [&](int64_t task, int) {
                                  ++calls;
                                  if (task >= 23 && task % 3 == 2)
                                    throw Error(Status::scene, "task " + std::to_string(task));
                                }),
                  Status::scene, "task 23");
      CHECK(calls >= 24);
      CHECK(calls <= 200);
    }
    std::atomic<int> calls{0};
    CHECK(team.for_each(10, [&](int64_t, int) { ++calls; }));
    CHECK_EQUAL(calls.load(), 10);
  }
}

// A late low task beats an early high one: task 0 throws only after task 1 has thrown.
void lowest_exception_wins_when_late() {
  ThreadTeam team(2);
  std::promise<void> thrown;
  std::shared_future<void> second = thrown.get_future().share();
  CHECK_FAILS(team.for_each(2,
                            [&](int64_t task, int) {
                              if (task == 1) {
                                thrown.set_value();
                                throw Error(Status::memory, "second");
                              }
                              second.wait_for(std::chrono::seconds(60));
                              throw Error(Status::scene, "first");
                            }),
              Status::scene, "first");
}

// After a throw no further task is started: on one thread exactly the tasks up to it ran.
void nothing_starts_after_a_throw() {
  ThreadTeam team(1);
  int calls = 0;
  CHECK_FAILS(team.for_each(100,
                            [&](int64_t task, int) {
                              ++calls;
                              if (task == 7) throw Error(Status::file, "seven");
                            }),
              Status::file, "seven");
  CHECK_EQUAL(calls, 8);
}

// Exceptions that are not ours come through with their own type.
void foreign_exceptions_pass() {
  ThreadTeam team(3);
  bool caught = false;
  try {
    team.for_each(5, [](int64_t, int) { throw std::bad_alloc(); });
  } catch (const std::bad_alloc&) {
    caught = true;
  }
  CHECK(caught);
}

void between_can_stop() {
  for (int size : kTeamSizes) {
    ThreadTeam team(size);
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<int64_t> calls{0};
    bool on_caller = true, ascending = true;
    int64_t last = 0;
    CHECK(!team.for_each(
        1000000, [&](int64_t, int) { ++calls; },
        [&](int64_t done) {
          on_caller = on_caller && std::this_thread::get_id() == caller;
          ascending = ascending && done >= last && done >= 1;
          last = done;
          return done < 10;
        }));
    CHECK(on_caller);
    CHECK(ascending);
    CHECK(last >= 10);
    CHECK(calls >= last);
    if (size == 1) CHECK_EQUAL(calls.load(), int64_t{10});
    CHECK(team.for_each(3, [&](int64_t, int) { ++calls; }));
  }
}

// While the caller waits for another worker's long task it still reports: this task ends only when
// it has been told so from between.
void between_is_called_while_waiting() {
  ThreadTeam team(2);
  std::atomic<int> reports{0};
  std::atomic<bool> caller_is_done{false};
  std::promise<void> release;
  std::shared_future<void> released = release.get_future().share();
  CHECK(team.for_each(
      2,
      [&](int64_t, int worker) {
        if (worker == 0) {
          caller_is_done = true;
        } else if (released.wait_for(std::chrono::seconds(60)) != std::future_status::ready) {
          throw std::runtime_error("between was not called while waiting");
        }
      },
      [&](int64_t) {
        if (caller_is_done && ++reports == 3) release.set_value();
        return true;
      }));
}

// A throw in between stops the loop like one in a body, and a body's exception goes before it.
void between_can_throw() {
  for (int size : kTeamSizes) {
    ThreadTeam team(size);
    CHECK_FAILS(team.for_each(
                    1000, [](int64_t, int) {},
                    [](int64_t) -> bool { throw Error(Status::stopped, "from between"); }),
                Status::stopped, "from between");
    CHECK_FAILS(team.for_each(
                    1, [](int64_t, int) { throw Error(Status::scene, "from the body"); },
                    [](int64_t) -> bool { throw Error(Status::stopped, "from between"); }),
                Status::scene, "from the body");
  }
}

// A loop inside a loop of the same team is an error instead of a deadlock.
void not_reentrant() {
  ThreadTeam team(2);
  CHECK_FAILS(team.for_each(3, [&](int64_t, int) { team.for_each(2, [](int64_t, int) {}); }),
              Status::internal, "running");
  CHECK(team.for_each(3, [](int64_t, int) {}));
}

// Many short loops: a worker that sleeps through one must not disturb the next.
void repeated_use() {
  ThreadTeam team(4);
  std::atomic<int64_t> sum{0};
  for (int pass = 0; pass < 3000; ++pass)
    CHECK(team.for_each(pass % 5, [&](int64_t task, int) { sum += task + 1; }));
  CHECK_EQUAL(sum.load(), int64_t{600 * (0 + 1 + 3 + 6 + 10)});
}

void teams_are_independent() {
  ThreadTeam outer(2), inner(2);
  std::atomic<int64_t> sum{0};
  CHECK(outer.for_each(
      1, [&](int64_t, int) { inner.for_each(10, [&](int64_t task, int) { sum += task; }); }));
  CHECK_EQUAL(sum.load(), int64_t{45});
}

// An observer is told of the loops of its team and of every task, and of no others'.
void an_observer_is_told() {
  struct Observer : hrad::WorkObserver {
    std::vector<int64_t> loops;
    std::atomic<int64_t> tasks{0}, sum{0};
    int ends = 0;
    void stage_begins(const char*) override {}
    void loop_begins(int64_t count) override { loops.push_back(count); }
    void task_ends(int64_t task, int worker) override {
      ++tasks;
      sum += task;
      if (worker < 0 || worker >= 4) sum += 1000000;
    }
    void loop_ends() override { ++ends; }
  };
  for (int size : {1, 4}) {
    Observer observer;
    ThreadTeam team(size);
    const auto nothing = [](int64_t, int) {};
    team.set_observer(&observer);
    team.for_each(100, nothing);
    ThreadTeam other(size);
    other.for_each(3, nothing);
    CHECK(!team.alone());
    team.set_observer(nullptr);
    CHECK_EQUAL(team.alone(), team.size() == 1);
    team.for_each(7, nothing);
    CHECK((observer.loops == std::vector<int64_t>{100}));
    CHECK_EQUAL(observer.ends, 1);
    CHECK_EQUAL(observer.tasks.load(), 100);
    CHECK_EQUAL(observer.sum.load(), 4950);
  }
}

// Binding to what exists, to nothing, to what doesn't exist: the work is done all the same.
void binding_is_harmless() {
  const std::vector<std::vector<std::vector<int>>> bindings = {
      {{0}, {0}, {0}}, {{}, {}, {}}, {{0}}, {{-1}, {-1}, {-1}}, {{0}, {5000}, {100000}}};
  for (const auto& binding : bindings) {
    ThreadTeam team(3, binding);
    std::atomic<int> calls{0};
    CHECK(team.for_each(100, [&](int64_t, int) { ++calls; }));
    CHECK_EQUAL(calls.load(), 100);
  }
}

// Where there is no room for the stacks of all threads, the constructor says so and leaves nothing
// behind. (The sanitizers' own memory makes such a limit meaningless.)
void too_many_threads() {
#if !HRAD_TEST_THREADS && !HRAD_TEST_ADDRESSES
  rlimit before;
  CHECK_EQUAL(getrlimit(RLIMIT_AS, &before), 0);
  rlimit narrow = before;
  narrow.rlim_cur = rlim_t{1} << 30;
  CHECK_EQUAL(setrlimit(RLIMIT_AS, &narrow), 0);
  bool failed = false;
  std::string message;
  try {
    ThreadTeam(4000);
  } catch (const Error& e) {
    failed = e.status() == Status::memory;
    message = e.what();
  }
  CHECK_EQUAL(setrlimit(RLIMIT_AS, &before), 0);
  CHECK(failed);
  CHECK(message.find("of 4000 threads") != std::string::npos);
#endif
  ThreadTeam team(3);
  std::atomic<int> calls{0};
  CHECK(team.for_each(9, [&](int64_t, int) { ++calls; }));
  CHECK_EQUAL(calls.load(), 9);
}

void bad_size() {
  CHECK_FAILS(ThreadTeam(0), Status::argument, "at least 1");
  CHECK_FAILS(ThreadTeam(-3), Status::argument, "-3");
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(every_task_once),
      HRAD_TEST(no_task),
      HRAD_TEST(one_thread_is_a_loop),
      HRAD_TEST(workers_run_at_once),
      HRAD_TEST(a_worker_is_one_thread),
      HRAD_TEST(lowest_exception_wins),
      HRAD_TEST(lowest_exception_wins_when_late),
      HRAD_TEST(nothing_starts_after_a_throw),
      HRAD_TEST(foreign_exceptions_pass),
      HRAD_TEST(between_can_stop),
      HRAD_TEST(between_is_called_while_waiting),
      HRAD_TEST(between_can_throw),
      HRAD_TEST(not_reentrant),
      HRAD_TEST(repeated_use),
      HRAD_TEST(teams_are_independent),
      HRAD_TEST(an_observer_is_told),
      HRAD_TEST(binding_is_harmless),
      HRAD_TEST(too_many_threads),
      HRAD_TEST(bad_size),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
