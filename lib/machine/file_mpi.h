// The part of a process that MPI started, written through MPI. Each process opens it by itself:
// nobody waits for another there, so that one that fails can leave at any time. Floor 2 (machine).
#pragma once

#include <string>

#include "machine/comm_mpi.h"
#include "machine/file_part.h"

namespace hrad {

// Whether every MPI takes this for the name of a file: Open MPI 4 ends the program where it is
// longer than the 244 bytes that it has room for, and ROMIO drops what stands before a colon.
bool is_name_for_mpi(const std::string& name);

class FilePartMpi final : public FilePart {
 public:
  // name: of the file, which is there; path: for messages. No call writes more bytes than stated.
  FilePartMpi(const std::string& name, std::string path, int64_t most_bytes_at_once);
  ~FilePartMpi() override;
  FilePartMpi(const FilePartMpi&) = delete;
  FilePartMpi& operator=(const FilePartMpi&) = delete;

  void write_at(uint64_t offset, const char* data, size_t size) override;
  bool read_start(char* data, size_t size) override;
  void finish() override;

 private:
  [[noreturn]] void fail_here(const char* step, int code, int system_error) const;

  const std::string path_;
  const int64_t most_bytes_at_once_;
  MPI_File file_ = MPI_FILE_NULL;
};

}  // namespace hrad
