// Who watches the stages of a solver and the tasks of its loops, so that a benchmark can measure
// them. Floor 2 (machine).
#pragma once

#include <cstdint>

namespace hrad {

class WorkObserver {
 public:
  virtual ~WorkObserver() = default;
  // On the thread that calls the solver, as loop_begins() and loop_ends().
  virtual void stage_begins(const char* name) = 0;
  virtual void loop_begins(int64_t tasks) = 0;
  // By the worker that has done the task. Not called for one that throws.
  virtual void task_ends(int64_t task, int worker) = 0;
  virtual void loop_ends() = 0;
};

}  // namespace hrad
