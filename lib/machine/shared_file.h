// A file that all processes write together, and that appears whole under its name or not at all.
// Floor 2 (machine).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "machine/comm.h"
#include "machine/file_part.h"
#include "machine/file_self.h"

namespace hrad {

// Rank 0 makes the temporary and gives it its name; every process writes its own bytes at their
// places. What fails on one of them fails on all, by the next collective function, and the old file
// is untouched.
class SharedFile {
 public:
  // Collective. path: rank 0's counts. FILE where one of them can't write there.
  SharedFile(Comm& comm, const std::string& path);
  // Not collective. Each byte is to be written by one process, in any order.
  void write_at(uint64_t offset, const void* data, size_t size);
  // Collective: as WholeFile::commit_keeping(), after all have written. Once, as the last call.
  void commit_keeping(int older);

 private:
  void open_part();

  Comm& comm_;
  std::string path_;
  std::unique_ptr<WholeFile> whole_;  // of rank 0
  std::unique_ptr<FilePart> part_;    // none: this process is alone, and writes the whole
};

}  // namespace hrad
