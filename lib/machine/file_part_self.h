// The part of a process that asks nobody but the system. Floor 2 (machine).
#pragma once

#include <string>

#include "machine/file_part.h"

namespace hrad {

class FilePartSelf final : public FilePart {
 public:
  // name: of the file, which is there; path: for messages.
  FilePartSelf(const std::string& name, std::string path);
  ~FilePartSelf() override;
  FilePartSelf(const FilePartSelf&) = delete;
  FilePartSelf& operator=(const FilePartSelf&) = delete;

  void write_at(uint64_t offset, const char* data, size_t size) override;
  bool read_start(char* data, size_t size) override;
  void finish() override;

 private:
  [[noreturn]] void fail_here(const char* step, int error) const;

  const std::string path_;
  int file_ = -1;
};

}  // namespace hrad
