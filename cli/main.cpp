// hrad, the command-line tool: finds the command, and turns everything that can end it into a
// message on stderr and an exit code. CLI: public headers only.
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "arguments.h"
#include "command.h"
#include "exit_code.h"
#include "hrad/hrad.h"
#include "launcher.h"
#include "signals.h"
#include "text_table.h"

namespace hrad::cli {
namespace {

std::string help_text() {
  TextTable table("ll");
  for (const Command& command : commands) table.add_row({command.name, command.summary});
  return std::string("hrad ") + hrad_version_text() +
         ": hierarchical radiosity of diffuse surfaces\n"
         "Usage: hrad COMMAND [ARGUMENTS]\n"
         "\n"
         "Commands:\n" +
         table.text(2) +
         "\n"
         "Options:\n"
         "  -h, --help  Print this help and exit; 'hrad COMMAND --help' tells of a command\n"
         "  --version   Print the version and exit\n"
         "\n"
         "Results go to stdout, everything else to stderr. Exit codes: 0 done, 2 usage, 3 scene,\n"
         "4 checkpoint file, 5 input or output, 6 memory, 7 not converged (the results are\n"
         "written), 8 MPI, 70 internal, 75 stopped with a checkpoint, 128 + N stopped by signal "
         "N.\n";
}

std::string command_names() {
  std::string names;
  for (const Command& command : commands)
    names += (names.empty() ? "" : ", ") + std::string(command.name);
  return names;
}

int run(const std::vector<std::string>& arguments, Output* output) {
  if (arguments.empty()) fail_usage("", "a command is missing");
  const std::string& name = arguments[0];
  if (name == "--help" || name == "-h") {
    *output << help_text();
    return exit_done;
  }
  if (name == "--version") {
    *output << std::string("hrad ") + hrad_version_text() + "\n";
    return exit_done;
  }
  for (const Command& command : commands) {
    if (name != command.name) continue;
    return command.run({arguments.begin() + 1, arguments.end()}, output);
  }
  if (name[0] == '-') fail_usage("", "unknown option '" + name + "'");
  throw Failure(exit_usage, "unknown command '" + name + "'", "commands: " + command_names());
}

int complain(int code, const std::string& message, const std::string& hint = {}) {
  if (!launcher::speaks()) return code;
  std::fprintf(stderr, "hrad: %s\n", message.c_str());
  if (!hint.empty()) std::fprintf(stderr, "hrad: %s\n", hint.c_str());
  return code;
}

// What met this process alone, whose others may be waiting for it.
int complain_alone(int code, const std::string& message) {
  std::fprintf(stderr, "hrad: %s\n", message.c_str());
  return launcher::finish_alone(code);
}

int guarded_main(const std::vector<std::string>& arguments) {
  try {
    Output output;
    const int code = run(arguments, &output);
    output.finish();
    return launcher::finish(code);
  } catch (const Failure& failure) {
    return launcher::finish(complain(failure.code(), failure.what(), failure.hint()));
  } catch (const Interrupted& interrupted) {
    return launcher::finish(complain(exit_signal + interrupted.signal,
                                     std::string("stopped: ") + ::strsignal(interrupted.signal)));
  } catch (const std::bad_alloc&) {
    return complain_alone(exit_memory, "out of memory");
  } catch (const std::exception& error) {
    return complain_alone(exit_internal, std::string("internal error: ") + error.what());
  }
}

}  // namespace
}  // namespace hrad::cli

int main(int argc, char** argv) {
  hrad::cli::guard_standard_streams();
  hrad::cli::signals::install();
  return hrad::cli::guarded_main({argv + (argc > 0), argv + argc});
}
