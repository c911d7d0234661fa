// What a stage that makes links has done so far, task by task: a stop, or a checkpoint, comes at
// any time, and the stage done again takes the results of finished tasks from here instead of
// tracing their rays. All else in it is decided by these, so that the result is the same, whoever
// did the tasks. Floor 7 (stages).
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "base/span.h"
#include "links/link.h"
#include "machine/sharing.h"
#include "machine/thread_team.h"

namespace hrad {

// Tasks of one pass that were done together, and what each of them found.
struct LinkStep {
  uint32_t pass = 0;
  std::vector<uint64_t> names;  // of the tasks
  std::vector<uint64_t> ends;   // of their results among the bytes
  Bytes results;

  // What was put to the results since the last task is this one's.
  void end_task(uint64_t name) {
    names.push_back(name);
    ends.push_back(results.size());
  }
  // The result of a task that is one run of links.
  void add_run(uint64_t name, Span<const Link> links, int64_t rays) {
    put(results, &rays, 1);
    put_list(results, links);
    end_task(name);
  }
};

// The result of a task, which may come from a file: nothing in it is sure.
class KnownResult {
 public:
  KnownResult(const char* first, size_t size) : next_(first), left_(size) {}
  // False, here and from now on: there is not so much.
  template <class T>
  bool take(T* values, size_t count) {
    if (count > left_ / sizeof(T)) left_ = 0, good_ = false;
    if (!good_) return false;
    if (count > 0) std::memcpy(static_cast<void*>(values), next_, count * sizeof(T));
    next_ += count * sizeof(T);
    left_ -= count * sizeof(T);
    return true;
  }
  // A list with its length in front, as put_list() puts it.
  template <class T>
  bool take_list(std::vector<T>& list) {
    uint64_t size = 0;
    if (!take(&size, 1) || size > left_ / sizeof(T)) return good_ = false;
    list.resize(size);
    return take(list.data(), size);
  }
  bool at_end() const { return good_ && left_ == 0; }

 private:
  const char* next_;
  size_t left_;
  bool good_ = true;
};

class LinkJournal {
 public:
  bool recording = false;
  int64_t rays_before = 0, pairs_before = 0;  // State::rays and pairs when the stage began

  // For a stage with all that this number stands for; what is known of another one is forgotten.
  void begin(uint64_t key, int64_t rays, int64_t pairs);
  void clear() { *this = with(recording); }
  bool empty() const { return steps_.empty(); }
  int64_t bytes() const { return bytes_; }

  // The next pass of the stage, in which every task has a name of its own. Passes follow each other
  // in the same way on all processes and every time.
  void next_pass();
  // The results of a task of this pass that was done before, one after the other until `use` says
  // that it has taken one: what it says no to must leave no trace. True when it did. Any thread.
  bool known(uint64_t name, const std::function<bool(KnownResult&)>& use) const;
  // Of a task that is to find one run of links: appends what is known of it, its links and rays.
  bool known_run(uint64_t name, const std::function<bool(NodeId)>& is_source,
                 std::vector<Link>& links, int64_t& rays) const;
  // Runs the tasks of a pass: in turns of some seconds where they are recorded, else all at once.
  // Between turns, and when `between` asks to stop, add(step, task) adds the result of each task
  // that has been done since the last time, if it is new. body and between as for
  // ThreadTeam::for_each; false: stopped.
  bool for_each(ThreadTeam& team, int64_t count,
                const std::function<void(int64_t task, int worker)>& body,
                const std::function<bool(int64_t done)>& between,
                const std::function<void(LinkStep& step, int64_t task)>& add);
  // The tasks of the next pass where each has one result, that of task k: take(k, known) says
  // whether it has taken what is known of it, else make(k, worker) makes it; put(k, bytes) gives
  // it.
  struct Results {
    std::function<uint64_t(size_t k)> name;
    std::function<bool(size_t k, KnownResult& known)> take;
    std::function<void(size_t k, int worker)> make;
    std::function<void(size_t k, Bytes& bytes)> put;
  };
  bool next_pass_of(ThreadTeam& team, size_t count, const Results& results,
                    const std::function<bool(int64_t done)>& between);

  // To be kept in a file.
  uint64_t key() const { return key_; }
  const std::vector<LinkStep>& steps() const { return steps_; }
  // Of these so many, the first ones, come from a file, and all processes have them.
  size_t restored_steps() const { return restored_steps_; }
  static LinkJournal restored(uint64_t key, int64_t rays_before, int64_t pairs_before,
                              std::vector<LinkStep> steps);

 private:
  static LinkJournal with(bool recording) {
    LinkJournal journal;
    journal.recording = recording;
    return journal;
  }
  void record(LinkStep step);  // of this pass
  void push(LinkStep step);

  struct Entry {
    uint64_t name;
    size_t step, task;
  };
  uint64_t key_ = 0;
  uint32_t pass_ = 0;
  std::vector<LinkStep> steps_;
  size_t restored_steps_ = 0;
  std::vector<Entry> known_;  // of this pass, by name
  int64_t bytes_ = 0;
};

// What a task may have counted, so that sums of them stay within their type.
inline bool is_count(int64_t number) { return number >= 0 && number <= int64_t{1} << 40; }

// Links whose sources are what they may be, and whose weights are weights.
bool are_links(const std::vector<Link>& links, const std::function<bool(NodeId)>& is_source);

}  // namespace hrad
