// What linking by rows has done so far, step by step: a stop, or a checkpoint, comes at any time,
// and linking done again takes the finished steps from here instead of tracing their rays. All else
// in it is decided by these, so that the result is the same. Floor 7 (stages).
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "links/link.h"

namespace hrad {

// One step: runs of links, one after the other, of points or of cells.
struct LinkStep {
  std::vector<uint32_t> counts;  // of each run
  std::vector<Link> links;
  std::vector<float> values;  // of each point; none of cells
  int64_t rays = 0;
  void append(const LinkStep& more);
};

class LinkJournal {
 public:
  bool recording = false;
  int64_t rays_before = 0;  // State::rays when linking began

  // For linking with all that this number stands for; what is known of another one is forgotten.
  void begin(uint64_t key, int64_t rays);
  void clear() { *this = with(recording); }
  bool empty() const { return steps_.empty(); }
  int64_t bytes() const { return bytes_; }

  // The next step, if it was done before: of so many runs, whose sources are all right; with values
  // or without. One that doesn't fit was made by something else: it and all behind it are dropped.
  const LinkStep* done(size_t runs, bool with_values, const std::function<bool(NodeId)>& is_source);
  // A step that was done now.
  void record(LinkStep step);

  // To be kept in a file.
  uint64_t key() const { return key_; }
  const std::vector<LinkStep>& steps() const { return steps_; }
  static LinkJournal restored(uint64_t key, int64_t rays_before, std::vector<LinkStep> steps);

 private:
  static LinkJournal with(bool recording) {
    LinkJournal journal;
    journal.recording = recording;
    return journal;
  }
  void push(LinkStep step);

  uint64_t key_ = 0;
  std::vector<LinkStep> steps_;
  size_t next_ = 0;
  int64_t bytes_ = 0;
};

}  // namespace hrad
