// Temporary, checked writes, rename (whole_file.h). CLI: public headers only.
#include "whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "exit_code.h"
#include "launcher.h"

namespace hrad::cli {
namespace {

constexpr int most_attempts = 10000;

class Temporary {
 public:
  explicit Temporary(const std::string& path) : path_(path), target_(path) {
    struct stat status {};
    const bool is_there = ::stat(path.c_str(), &status) == 0;
    if (is_there) {
      if (!S_ISREG(status.st_mode)) fail("not a regular file, will not be replaced");
      const std::unique_ptr<char, void (*)(void*)> resolved(::realpath(path.c_str(), nullptr),
                                                            std::free);
      if (!resolved) fail_with(errno);
      target_ = resolved.get();
    }
    open_beside_target();
    if (is_there && ::fchmod(file_, status.st_mode & 07777) != 0) fail_with(errno);
  }
  ~Temporary() {
    if (file_ >= 0) ::close(file_);
    if (!name_.empty()) ::unlink(name_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  void write(const char* data, size_t size) {
    while (size > 0) {
      const ssize_t written = ::write(file_, data, size);
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) fail_with(written < 0 ? errno : EIO);
      data += written;
      size -= static_cast<size_t>(written);
    }
  }
  void take_place() {
    // Some file systems have no fsync and say EINVAL.
    if (::fsync(file_) != 0 && errno != EINVAL) fail_with(errno);
    const int closed = ::close(file_);
    file_ = -1;
    if (closed != 0 && errno != EINTR) fail_with(errno);
    if (::rename(name_.c_str(), target_.c_str()) != 0) fail_with(errno);
    name_.clear();
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw Failure(exit_input_output, "can't write '" + path_ + "': " + reason);
  }
  [[noreturn]] void fail_with(int error) const { fail(std::strerror(error)); }

  void open_beside_target() {
    const std::string folder = target_.substr(0, target_.find_last_of('/') + 1);
    // Names that dead processes left behind are passed over.
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
      const std::string name =
          folder + ".hrad-" + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".tmp";
      file_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (file_ >= 0) {
        name_ = name;
        return;
      }
      if (errno != EEXIST && errno != EINTR) break;
    }
    fail_with(errno);
  }

  std::string path_, target_, name_;  // target: path with links resolved
  int file_ = -1;
};

}  // namespace

void write_whole_file(const std::string& path, const void* data, size_t size) {
  launcher::on_first([&] {
    Temporary temporary(path);
    temporary.write(static_cast<const char*>(data), size);
    temporary.take_place();
  });
}

}  // namespace hrad::cli
