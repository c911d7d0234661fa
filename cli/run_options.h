// The options of every command that works on a scene: where it comes from, the parameters, how much
// is said. CLI: public headers only.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arguments.h"
#include "terminal.h"

namespace hrad::cli {

class RunOptions {
 public:
  // Scenes are solved by all processes of a launcher together; the rest is the first one's work.
  enum Takes { a_scene_to_solve, a_scene, no_scene };

  void add_to(Arguments* arguments, const std::string& command, Takes takes);
  // What can be judged before anything is loaded: Failure (usage, scene, MPI). Call after parsing.
  // Starts MPI. False where this process has nothing to do.
  bool check();

  const std::string& scene() const { return scene_; }
  bool scene_is_file() const { return scene_is_file_; }  // after check()
  bool scene_is_checkpoint() const;                      // a .hrad file, which is a file too
  Verbosity verbosity() const;
  // Names and values for hrad_set_text, in the order of the table of options.
  std::vector<std::pair<std::string, std::string>> parameters() const;

 private:
  bool looks_like_file() const;
  bool start_launcher() const;

  std::string command_;
  Takes takes_ = no_scene;
  std::string scene_;
  bool scene_is_file_ = false;
  std::optional<std::string> accuracy_, threads_, mpi_;
  std::vector<std::string> set_;
  bool two_sided_ = false, flip_ = false, quiet_ = false, verbose_ = false;
};

// Whether a path names a .hrad file: its ending tells.
bool is_checkpoint(const std::string& path);

// The built-in scenes, separated by commas; and whether a name is one of them.
std::string builtin_scene_names();
bool is_builtin_scene(const std::string& name);

}  // namespace hrad::cli
