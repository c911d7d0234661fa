// Ranks that are threads, of which some can't write what they should: a step on the file that all
// write together fails, as on a full disk.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "base/error.h"
#include "machine/file_part_self.h"
#include "support/thread_ranks.h"

namespace hrad_test {

// Opening, reading, every writing and finishing are a step each.
class FailingComm : public CommThreads {
 public:
  using CommThreads::CommThreads;
  int failing_step = -1;  // of the next file, from 0; negative: none
  int steps = 0;          // taken in the last file

  std::unique_ptr<hrad::FilePart> open_part(const std::string& name,
                                            const std::string& path) override {
    steps = 0;
    take_step(path);
    return std::make_unique<Part>(*this, name, path);
  }

 private:
  void take_step(const std::string& path) {
    if (steps++ == failing_step)
      throw hrad::Error(hrad::Status::file,
                        path + ": rank " + std::to_string(rank()) + " has no space left");
  }

  class Part : public hrad::FilePart {
   public:
    Part(FailingComm& comm, const std::string& name, std::string path)
        : comm_(comm), path_(std::move(path)), file_(name, path_) {}
    void write_at(uint64_t offset, const char* data, size_t size) override {
      file_.write_at(offset, data, size / 2);
      comm_.take_step(path_);
      file_.write_at(offset + size / 2, data + size / 2, size - size / 2);
    }
    bool read_start(char* data, size_t size) override {
      comm_.take_step(path_);
      return file_.read_start(data, size);
    }
    void finish() override {
      comm_.take_step(path_);
      file_.finish();
    }

   private:
    FailingComm& comm_;
    const std::string path_;
    hrad::FilePartSelf file_;
  };
};

inline void on_failing_ranks(int ranks, const std::function<void(FailingComm&)>& body) {
  on_threads(ranks, [&](Hub& hub, int rank) {
    FailingComm comm(hub, rank);
    body(comm);
  });
}

}  // namespace hrad_test
