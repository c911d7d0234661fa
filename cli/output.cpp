// Writing stdout (output.h). CLI: public headers only.
#include "output.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "exit_code.h"
#include "launcher.h"

namespace hrad::cli {
namespace {

constexpr size_t most_held = size_t{64} << 20;  // bytes

}  // namespace

void Output::relieve() {
  if (text_.size() >= most_held) write_all();
}

void Output::finish() { write_all(); }

void Output::write_all() {
  launcher::on_first([this] { write_text(); });
  text_.clear();
}

void Output::write_text() const {
  const char* next = text_.data();
  size_t left = text_.size();
  while (left > 0) {
    const ssize_t written = ::write(STDOUT_FILENO, next, left);
    if (written < 0) {
      if (errno == EINTR) continue;
      throw Failure(exit_input_output,
                    std::string("can't write to standard output: ") + std::strerror(errno));
    }
    next += written;
    left -= static_cast<size_t>(written);
  }
}

void guard_standard_streams() {
  for (int descriptor = 0; descriptor <= 2; ++descriptor) {
    if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
    // The lowest free number is this one. Stdin and stdout get the wrong direction on purpose:
    // reading or writing them goes on being an error. What is said on stderr may get lost.
    const int mode = descriptor == 0 ? O_WRONLY : descriptor == 1 ? O_RDONLY : O_WRONLY;
    if (::open("/dev/null", mode) != descriptor) return;
  }
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace hrad::cli
