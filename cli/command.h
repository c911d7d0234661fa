// The commands of hrad: one row each in the table, one file each for what they do. CLI: public
// headers only.
#pragma once

#include <string>
#include <vector>

#include "output.h"

namespace hrad::cli {

// Does the command with the arguments behind its name and returns the exit code. What belongs on
// stdout goes to output; main writes it. Throws Failure or Interrupted.
using CommandFunction = int (*)(const std::vector<std::string>& arguments, Output* output);

struct Command {
  const char* name;
  const char* summary;
  CommandFunction run;
};

int run_solve(const std::vector<std::string>& arguments, Output* output);
int run_export(const std::vector<std::string>& arguments, Output* output);
int run_render(const std::vector<std::string>& arguments, Output* output);
int run_query(const std::vector<std::string>& arguments, Output* output);
int run_info(const std::vector<std::string>& arguments, Output* output);
int run_check(const std::vector<std::string>& arguments, Output* output);
int run_scene(const std::vector<std::string>& arguments, Output* output);
int run_partition(const std::vector<std::string>& arguments, Output* output);
int run_machine(const std::vector<std::string>& arguments, Output* output);
int run_params(const std::vector<std::string>& arguments, Output* output);

inline constexpr Command commands[] = {
    {"solve", "Solve a scene, print a summary, write the result", run_solve},
    {"export", "Solve a scene and write the result, without a summary", run_export},
    {"render", "Solve a scene and write a picture of it", run_render},
    {"query", "Solve a scene and print values at patches, points or grids", run_query},
    {"info", "Print what is in a scene, without solving it", run_info},
    {"check", "Verify every checksum and invariant of a .hrad file", run_check},
    {"partition", "Print what each rank of a cluster would get", run_partition},
    {"scene", "Write a built-in scene as an OBJ file, or list their names", run_scene},
    {"machine", "Print what is seen of this machine, and the threads started here", run_machine},
    {"params", "Print the table of parameters", run_params},
};

}  // namespace hrad::cli
