// pwrite, fsync, close. Floor 2 (machine).
#include "machine/descriptor.h"

#include <unistd.h>

#include <cerrno>
#include <utility>

namespace hrad {

int write_all(int file, uint64_t offset, const char* data, size_t size) {
  while (size > 0) {
    const ssize_t written = ::pwrite(file, data, size, static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return written < 0 ? errno : EIO;
    data += written;
    size -= static_cast<size_t>(written);
    offset += static_cast<uint64_t>(written);
  }
  return 0;
}

// Some file systems have no fsync and say EINVAL; everything else is data that may be lost.
int synchronise(int file) { return ::fsync(file) != 0 && errno != EINVAL ? errno : 0; }

int close_checked(int& file) {
  return ::close(std::exchange(file, -1)) != 0 && errno != EINTR ? errno : 0;
}

}  // namespace hrad
