// Records the timeline of each rank of a solve: ranks are threads of one process (thread_ranks.h)
// with one worker each. Only one of them computes at a time, the others wait, and what counts is
// the CPU time of the thread itself: so neither ranks nor other programs stand in each other's way
// more than a shared cache makes them.
#pragma once

#include <execinfo.h>
#include <time.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "machine/work_observer.h"
#include "support/thread_ranks.h"
#include "support/timeline.h"

namespace hrad_test {

inline double thread_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// What looking at the clock costs, which is as much as a small task.
inline double clock_seconds() {
  constexpr int looks = 2000;
  double least = 1;
  for (int turn = 0; turn < 5; ++turn) {
    const double begin = thread_seconds();
    for (int k = 1; k < looks; ++k) thread_seconds();
    least = std::min(least, (thread_seconds() - begin) / looks);
  }
  return least;
}

// What recording ranks share, each while it holds the turn to compute.
struct Recorders {
  explicit Recorders(int ranks) { recording.ranks.resize(static_cast<size_t>(ranks)); }
  Recording recording;
  std::mutex turn;
  const double look = clock_seconds();
};

// Of one rank, whose solver it observes. Made and used on its thread.
class Recorder final : public hrad::WorkObserver {
 public:
  Recorder(Recorders& all, int rank)
      : all_(all), events_(all.recording.ranks[static_cast<size_t>(rank)]), turn_(all.turn) {
    stage_ = all_.recording.stage_number("before");
    last_ = thread_seconds();
  }

  void stage_begins(const char* name) override {
    end_stretch();
    stage_ = all_.recording.stage_number(name);
    last_ = thread_seconds();
  }
  void loop_begins(int64_t tasks) override {
    end_stretch();
    add(Kind::loop).tasks.reserve(static_cast<size_t>(tasks));
    last_ = thread_seconds();
  }
  void task_ends(int64_t, int) override {
    const double now = thread_seconds();
    events_.back().tasks.push_back(std::max(0.0, now - last_ - all_.look));
    last_ = now;
  }
  void loop_ends() override {}

  // Lets the other ranks compute while this one has to do with them.
  template <class Body>
  auto exchanging(Kind kind, std::vector<int64_t> bytes, const Body& body) {
    struct Pause {
      explicit Pause(Recorder& owner) : owner(owner) { owner.turn_.unlock(); }
      ~Pause() {
        owner.turn_.lock();
        owner.last_ = thread_seconds();
      }
      Recorder& owner;
    };
    end_stretch();
    add(kind).bytes = std::move(bytes);
    const Pause pause(*this);
    return body();
  }

 private:
  void end_stretch() {
    const double seconds = thread_seconds() - last_ - all_.look;
    Event event;
    event.stage = stage_;
    event.seconds = std::max(0.0, seconds);
    events_.push_back(std::move(event));
  }
  Event& add(Kind kind) {
    void* stack[32];
    const int depth = backtrace(stack, 32);
    Event event;
    event.kind = kind;
    event.stage = stage_;
    event.site = all_.recording.site_number(std::vector<void*>(stack, stack + depth));
    events_.push_back(std::move(event));
    return events_.back();
  }

  Recorders& all_;
  Timeline& events_;
  std::unique_lock<std::mutex> turn_;
  int32_t stage_ = 0;
  double last_ = 0;
};

class RecordingComm final : public CommThreads {
 public:
  RecordingComm(Hub& hub, int rank, Recorder& recorder)
      : CommThreads(hub, rank), recorder_(recorder) {}

 protected:
  static int64_t size_of(const Bytes& bytes) { return static_cast<int64_t>(bytes.size()); }

  std::vector<Word> do_tell(const Word& mine) override {
    return recorder_.exchanging(Kind::tell, {}, [&] { return CommThreads::do_tell(mine); });
  }
  void do_broadcast(Bytes& data, int root) override {
    recorder_.exchanging(Kind::broadcast, {root == rank() ? size_of(data) : 0},
                         [&] { CommThreads::do_broadcast(data, root); });
  }
  std::vector<Bytes> do_gather_all(const Bytes& mine) override {
    return recorder_.exchanging(Kind::gather_all, {size_of(mine)},
                                [&] { return CommThreads::do_gather_all(mine); });
  }
  void do_start_exchange(std::vector<Bytes> to) override {
    std::vector<int64_t> bytes;
    for (const Bytes& one : to) bytes.push_back(size_of(one));
    recorder_.exchanging(Kind::start_exchange, std::move(bytes),
                         [&] { CommThreads::do_start_exchange(std::move(to)); });
  }
  std::vector<Bytes> do_finish_exchange() override {
    return recorder_.exchanging(Kind::finish_exchange, {},
                                [&] { return CommThreads::do_finish_exchange(); });
  }
  void do_add_up(hrad::Span<uint64_t> values) override {
    recorder_.exchanging(Kind::add_up, {static_cast<int64_t>(values.size() * sizeof(uint64_t))},
                         [&] { CommThreads::do_add_up(values); });
  }

 private:
  Recorder& recorder_;
};

}  // namespace hrad_test
