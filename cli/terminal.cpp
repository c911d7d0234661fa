// Writing stderr (terminal.h). CLI: public headers only.
#include "terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>

#include "launcher.h"

namespace hrad::cli {
namespace {

// The last column stays free: a character there makes some terminals begin a new line.
size_t usable_columns() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 2) return 79;
  return size.ws_col - 1u;
}

}  // namespace

Terminal::Terminal(Verbosity verbosity)
    : verbosity_(verbosity),
      shows_line_(verbosity != Verbosity::quiet && launcher::speaks() &&
                  ::isatty(STDERR_FILENO) != 0) {}

Terminal::~Terminal() { clear_line(); }

void Terminal::say(const std::string& message) {
  if (!launcher::speaks()) return;
  const std::string line = line_;
  clear_line();
  std::fprintf(stderr, "hrad: %s\n", message.c_str());
  if (!line.empty()) show_line(line);
}

void Terminal::show_line(const std::string& line) {
  if (!shows_line_) return;
  const std::string cut = line.substr(0, usable_columns());
  if (cut == line_) return;
  // Blanks over the rest of a longer line: no escape sequence that a terminal may not know.
  const std::string rest(line_.size() > cut.size() ? line_.size() - cut.size() : 0, ' ');
  std::fprintf(stderr, "\r%s%s", cut.c_str(), rest.c_str());
  std::fflush(stderr);
  line_ = cut;
}

void Terminal::clear_line() {
  if (line_.empty()) return;
  std::fprintf(stderr, "\r%s\r", std::string(line_.size(), ' ').c_str());
  std::fflush(stderr);
  line_.clear();
}

}  // namespace hrad::cli
