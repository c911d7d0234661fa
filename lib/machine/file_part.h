// One process's way into a file that several write, each its own bytes. Floor 2 (machine).
#pragma once

#include <cstddef>
#include <cstdint>

namespace hrad {

// Every failure throws FILE with the path that the file is to have and the system's reason.
class FilePart {
 public:
  virtual ~FilePart() = default;  // closes what is not finished
  virtual void write_at(uint64_t offset, const char* data, size_t size) = 0;
  // The first bytes of the file. False: there are not so many.
  virtual bool read_start(char* data, size_t size) = 0;
  // What was written is on the disk, and the file is closed. Once, as the last call.
  virtual void finish() = 0;
};

}  // namespace hrad
