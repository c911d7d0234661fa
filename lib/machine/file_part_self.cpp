// One descriptor. Floor 2 (machine).
#include "machine/file_part_self.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "machine/descriptor.h"

namespace hrad {

FilePartSelf::FilePartSelf(const std::string& name, std::string path) : path_(std::move(path)) {
  do file_ = ::open(name.c_str(), O_RDWR | O_CLOEXEC);
  while (file_ < 0 && errno == EINTR);
  if (file_ < 0) fail_here("open", errno);
}

FilePartSelf::~FilePartSelf() {
  if (file_ >= 0) ::close(file_);
}

void FilePartSelf::fail_here(const char* step, int error) const {
  fail(Status::file, "%s: cannot %s: %s", path_.c_str(), step, std::strerror(error));
}

void FilePartSelf::write_at(uint64_t offset, const char* data, size_t size) {
  if (const int error = write_all(file_, offset, data, size)) fail_here("write", error);
}

bool FilePartSelf::read_start(char* data, size_t size) {
  for (size_t done = 0; done < size;) {
    const ssize_t count = ::pread(file_, data + done, size - done, static_cast<off_t>(done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail_here("read", errno);
    if (count == 0) return false;
    done += static_cast<size_t>(count);
  }
  return true;
}

void FilePartSelf::finish() {
  if (const int error = synchronise(file_)) fail_here("write", error);
  if (const int error = close_checked(file_)) fail_here("write", error);
}

}  // namespace hrad
