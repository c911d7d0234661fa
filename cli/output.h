// What a command says on stdout: gathered, so that a command that fails says nothing there, and
// checked, so that a full disk or a closed pipe is an error. CLI: public headers only.
#pragma once

#include <string>
#include <string_view>

namespace hrad::cli {

class Output {
 public:
  std::string& text() { return text_; }
  void operator<<(std::string_view more) { text_ += more; }

  // Writes what has gathered when it is too much to hold any longer; for tables of any length.
  void relieve();
  // Writes everything. Failure (input/output) when stdout doesn't take it.
  void finish();

 private:
  void write_all();  // by the first of all processes
  void write_text() const;
  std::string text_;
};

// Makes sure that descriptors 0 to 2 are open, so that no file that is opened later gets one of
// their numbers and receives what was meant for them; a closed pipe becomes an error of write.
void guard_standard_streams();

}  // namespace hrad::cli
