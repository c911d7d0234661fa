// hrad check. CLI: public headers only.
#include "arguments.h"
#include "command.h"
#include "launcher.h"
#include "session.h"

namespace hrad::cli {

int run_check(const std::vector<std::string>& arguments, Output* output) {
  std::string path;
  Arguments parser(
      "check", "Verify every checksum and invariant of a .hrad file.",
      "A file that is damaged is refused with exit code 4 and what is damaged in it.\n\n"
      "Example: hrad check room.hrad");
  parser.add_positional("FILE.hrad", &path, "A solution or a checkpoint");
  if (!parser.parse(arguments, &output->text())) return 0;
  if (!launcher::start(launcher::Choice::automatic, launcher::Work::of_the_first)) return 0;
  *output << fetch_text([&](char* text, int64_t size, int64_t* needed) {
    return hrad_describe_checkpoint(path.c_str(), text, size, needed);
  });
  return 0;
}

}  // namespace hrad::cli
