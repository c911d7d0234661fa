// The processes that solve one problem together, one per node (paper, Section 3.1), and what they
// tell each other. All of them fail together: whatever goes wrong on one is known to all before
// anything is exchanged again, so that none waits for another in vain. Floor 2 (machine).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/span.h"
#include "machine/file_part.h"

namespace hrad {

using Bytes = std::vector<char>;

// What went wrong, on this process or another, and is known to all of them.
class AgreedError : public Error {
 public:
  using Error::Error;
};

// Collective: all processes call the same functions in the same order, each on the thread that
// made the solver. Where one calls fail_all() instead, every collective function of the others
// throws its error, AgreedError, on all of them the same.
class Comm {
 public:
  virtual ~Comm() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  bool alone() const { return size() == 1; }

  // Collective. True when every process goes on. All that was raised is forgotten.
  bool all_go_on(bool mine = true);
  // Collective, in place of what the others call. Throws the AgreedError that they throw too: where
  // several fail, that of the lowest rank.
  [[noreturn]] void fail_all(Status status, const char* message);
  // Not collective: tells all others that going on is of no use, because this one stops or fails;
  // they may look at it in the midst of their work.
  void raise();
  bool raised();

  // Collective. Rank 0's bytes, on all.
  void broadcast(Bytes& data);
  // Collective. What every process gives, in the order of ranks.
  std::vector<Bytes> gather_all(const Bytes& mine);
  // Collective. to[rank] goes to that rank, one for each; what came from each is handed out by
  // finish(), after which the next exchange may start. Work between the two overlaps the messages.
  void start_exchange(std::vector<Bytes> to);
  std::vector<Bytes> finish_exchange();
  bool exchanging() const { return exchanging_; }  // started and not yet finished
  std::vector<Bytes> exchange(std::vector<Bytes> to) {
    start_exchange(std::move(to));
    return finish_exchange();
  }
  // Collective. Over all processes, element by element: exact in any order.
  void add_up(Span<uint64_t> values);

  // Not collective: a way of these processes' own into a file that is there, whose path will be
  // another one; FILE when it can't be opened. nullptr: there is no way but the system's.
  virtual std::unique_ptr<FilePart> open_part(const std::string& /*name*/,
                                              const std::string& /*path*/) {
    return nullptr;
  }

  // A number for the node that this process runs on, the same for all that share its memory.
  virtual int node() const { return 0; }
  // Whether this process may have threads besides the one that communicates.
  virtual bool threads_ok() const { return true; }

 protected:
  // What each process says before anything is exchanged.
  struct Word {
    int32_t status = 0;  // negative: it has failed
    int32_t goes_on = 1;
    int32_t raised = 0;  // it has told the others so, since the last time
  };
  // Every process's word, in the order of ranks.
  virtual std::vector<Word> do_tell(const Word& mine) = 0;
  virtual void do_broadcast(Bytes& data, int root) = 0;
  virtual std::vector<Bytes> do_gather_all(const Bytes& mine) = 0;
  virtual void do_start_exchange(std::vector<Bytes> to) = 0;
  virtual std::vector<Bytes> do_finish_exchange() = 0;
  virtual void do_add_up(Span<uint64_t> values) = 0;
  virtual void do_raise() = 0;                    // to every other process
  virtual bool do_raised() = 0;                   // by any of them
  virtual void do_settle(int others_raised) = 0;  // takes in what so many of them have raised

 private:
  bool agree(Word mine, const char* message);

  bool has_raised_ = false, exchanging_ = false;
};

}  // namespace hrad
