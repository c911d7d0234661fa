// Who watches the work that a thread directs: the stages it goes through and the tasks of its
// loops, so that a benchmark can measure them. One for each thread and not for each team, because a
// rank is the thread that calls, and its teams and stages lie deep inside a solver. Unwatched,
// nothing is done beyond looking at one pointer for each loop. Floor 2 (machine).
#pragma once

#include <cstdint>

namespace hrad {

class WorkObserver {
 public:
  virtual ~WorkObserver() = default;
  // On the thread that is watched, as loop_begins() and loop_ends().
  virtual void stage_begins(const char* name) = 0;
  virtual void loop_begins(int64_t tasks) = 0;
  // By the worker that has done the task. Not called for one that throws.
  virtual void task_ends(int64_t task, int worker) = 0;
  virtual void loop_ends() = 0;
};

// Of this thread; null: nobody watches.
inline WorkObserver*& work_observer() {
  thread_local WorkObserver* observer = nullptr;
  return observer;
}

}  // namespace hrad
