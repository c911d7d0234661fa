// Options of commands that work on a scene (run_options.h). CLI: public headers only.
#include "run_options.h"

#include <sys/stat.h>

#include <set>

#include "exit_code.h"
#include "hrad/hrad.h"
#include "launcher.h"

namespace hrad::cli {
namespace {

bool ends_with(const std::string& text, const std::string& ending) {
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

bool exists(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0;
}

}  // namespace

void RunOptions::add_to(Arguments* arguments, const std::string& command, Takes takes) {
  command_ = command;
  takes_ = takes;
  if (takes != no_scene)
    arguments->add_positional("SCENE", &scene_,
                              "An OBJ file, the name of a built-in scene (hrad scene --list), or a "
                              "solution in a .hrad file");
  arguments->add_option("--accuracy", "X", &accuracy_,
                        "Relative error of patch means to reach (parameter accuracy)");
  arguments->add_option("--threads", "N", &threads_,
                        "Threads, 0: as many as this process may use (parameter threads)");
  arguments->add_list("--set", "NAME=VALUE", &set_,
                      "Set any parameter of the table that 'hrad params' prints");
  arguments->add_flag("--two-sided", &two_sided_, "All surfaces of the file have two sides");
  arguments->add_flag("--flip", &flip_, "The windings of the file are the wrong way round");
  arguments->exclude("--two-sided", "--flip");
  arguments->add_option("--mpi", "on|off|auto", &mpi_,
                        "Work together with the other processes of mpirun or srun");
  arguments->add_flag("-q,--quiet", &quiet_, "Say nothing on stderr but errors");
  arguments->add_flag("-v,--verbose", &verbose_, "Say on stderr what is being done");
  arguments->exclude("--quiet", "--verbose");
}

bool RunOptions::check() {
  std::set<std::string> names;
  for (const auto& item : parameters())
    if (!names.insert(item.first).second)
      fail_usage(command_, "parameter '" + item.first + "' is given twice");
  if (!start_launcher()) return false;
  if (takes_ == no_scene) return true;
  scene_is_file_ = launcher::of_first(looks_like_file()) != 0;
  if (!scene_is_file_ && !is_builtin_scene(scene_))
    throw Failure(exit_scene, "'" + scene_ + "' is neither a file nor a built-in scene",
                  "built-in scenes: " + builtin_scene_names());
  return true;
}

bool RunOptions::start_launcher() const {
  using namespace launcher;
  const std::string mpi = mpi_.value_or("auto");
  if (mpi != "on" && mpi != "off" && mpi != "auto")
    fail_usage(command_, "--mpi takes on, off or auto, not '" + mpi + "'");
  return start(mpi == "on"    ? Choice::on
               : mpi == "off" ? Choice::off
                              : Choice::automatic,
               takes_ == a_scene_to_solve ? Work::of_all : Work::of_the_first);
}

bool is_checkpoint(const std::string& path) { return ends_with(path, ".hrad"); }

bool RunOptions::scene_is_checkpoint() const { return is_checkpoint(scene_); }

bool RunOptions::looks_like_file() const {
  // A built-in name means the built-in scene wherever one works; ./NAME is the file.
  if (is_builtin_scene(scene_)) return false;
  return ends_with(scene_, ".obj") || scene_is_checkpoint() ||
         scene_.find('/') != std::string::npos || exists(scene_);
}

Verbosity RunOptions::verbosity() const {
  return quiet_ ? Verbosity::quiet : verbose_ ? Verbosity::verbose : Verbosity::normal;
}

std::vector<std::pair<std::string, std::string>> RunOptions::parameters() const {
  std::vector<std::pair<std::string, std::string>> result;
  if (accuracy_) result.emplace_back("accuracy", *accuracy_);
  if (threads_) result.emplace_back("threads", *threads_);
  if (two_sided_) result.emplace_back("sides", "two-sided");
  if (flip_) result.emplace_back("sides", "flip");
  for (const std::string& text : set_) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      fail_usage(command_, "--set takes NAME=VALUE, not '" + text + "'");
    result.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return result;
}

std::string builtin_scene_names() {
  std::string names;
  for (int64_t i = 0; hrad_scene_name(i) != nullptr; ++i)
    names += (i > 0 ? ", " : "") + std::string(hrad_scene_name(i));
  return names;
}

bool is_builtin_scene(const std::string& name) {
  for (int64_t i = 0; hrad_scene_name(i) != nullptr; ++i)
    if (name == hrad_scene_name(i)) return true;
  return false;
}

}  // namespace hrad::cli
