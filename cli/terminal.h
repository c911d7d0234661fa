// What a command says on stderr, by the first of several processes alone: messages, and one line
// that is written over while it works and only when stderr is a terminal. CLI: public headers only.
#pragma once

#include <string>

namespace hrad::cli {

enum class Verbosity { quiet, normal, verbose };

class Terminal {
 public:
  explicit Terminal(Verbosity verbosity);
  ~Terminal();  // leaves no line behind
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  Verbosity verbosity() const { return verbosity_; }
  bool shows_line() const { return shows_line_; }

  // One whole line, "hrad: " before it. The line that is written over makes room.
  void say(const std::string& message);
  void show_line(const std::string& line);
  void clear_line();

 private:
  Verbosity verbosity_;
  bool shows_line_;
  std::string line_;  // on the screen now
};

}  // namespace hrad::cli
