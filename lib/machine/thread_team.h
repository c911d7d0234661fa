// The thread pool of a node: tasks taken on demand by a free thread (paper, Section 3.2). The
// calling thread is worker 0 and works too. Floor 2 (machine).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace hrad {

class ThreadTeam {
 public:
  // Starts threads-1 threads. binding: for each worker the list of operating-system processor
  // numbers it may run on; empty: no binding (worker 0, the caller's thread, is never bound).
  explicit ThreadTeam(int threads, std::vector<std::vector<int>> binding = {});
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  int size() const;
  // Whether one thread does it all, and no observer wants to know how several would share it: what
  // is quicker then, and gives the same, may be done instead.
  bool alone() const { return size() == 1 && !observer_; }
  // Tells an observer, which must outlive this, of every loop from now on; nullptr: nobody.
  void set_observer(class WorkObserver* observer) { observer_ = observer; }

  // Runs body(task, worker) for every task 0 <= task < count, in ascending order of being taken,
  // each by one worker 0 <= worker < size(); returns when all are done. between(done) is called now
  // and then on the calling thread with the number of finished tasks, at last with that of all;
  // when it returns false, no further task is started and for_each returns false (tasks under way
  // are finished). When bodies throw, no further task is started and the exception of the lowest
  // task that throws is thrown here, the same one on any number of threads. Not reentrant.
  bool for_each(int64_t count, const std::function<void(int64_t task, int worker)>& body,
                const std::function<bool(int64_t done)>& between = {});

 private:
  bool run(int64_t count, const std::function<void(int64_t task, int worker)>& body,
           const std::function<bool(int64_t done)>& between);

  struct State;
  std::unique_ptr<State> state_;
  class WorkObserver* observer_ = nullptr;
};

}  // namespace hrad
