// Options of commands that work on a scene (run_options.h). CLI: public headers only.
#include "run_options.h"

#include <sys/stat.h>

#include <cstdlib>
#include <set>

#include "exit_code.h"
#include "hrad/hrad.h"
#include "numbers.h"

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

// The number of processes that mpirun or srun started this one among, 1 without a launcher.
int64_t launched_processes() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    const char* text = std::getenv(name);
    int64_t number = 0;
    if (text != nullptr && read_integer(text, &number) && number >= 1) return number;
  }
  return 1;
}

}  // namespace

void RunOptions::add_to(Arguments* arguments, const std::string& command, Takes takes) {
  command_ = command;
  takes_ = takes;
  if (takes == a_scene)
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

void RunOptions::check() const {
  std::set<std::string> names;
  for (const auto& item : parameters())
    if (!names.insert(item.first).second)
      fail_usage(command_, "parameter '" + item.first + "' is given twice");
  check_launcher();
  if (takes_ == a_scene) check_scene();
}

void RunOptions::check_scene() const {
  if (!scene_is_file() && !is_builtin_scene(scene_))
    throw Failure(exit_scene, "'" + scene_ + "' is neither a file nor a built-in scene",
                  "built-in scenes: " + builtin_scene_names());
}

void RunOptions::check_launcher() const {
  const std::string mpi = mpi_.value_or("auto");
  if (mpi != "on" && mpi != "off" && mpi != "auto")
    fail_usage(command_, "--mpi takes on, off or auto, not '" + mpi + "'");
  if (mpi == "on") throw Failure(exit_mpi, "--mpi on: this build has no MPI");
  const int64_t processes = launched_processes();
  if (mpi == "auto" && processes > 1)
    throw Failure(exit_mpi,
                  "started as one of " + std::to_string(processes) +
                      " processes, but this build has no MPI: all would do the same work",
                  "start one process, or say --mpi off if that is what you want");
}

bool is_checkpoint(const std::string& path) { return ends_with(path, ".hrad"); }

bool RunOptions::scene_is_checkpoint() const { return is_checkpoint(scene_); }

bool RunOptions::scene_is_file() const {
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
