// hrad scene. CLI: public headers only.
#include "command.h"
#include "exit_code.h"
#include "launcher.h"
#include "output_files.h"
#include "run_options.h"
#include "session.h"

namespace hrad::cli {

int run_scene(const std::vector<std::string>& arguments, Output* output) {
  std::string name;
  OutputFiles files(OutputFiles::scenes);
  bool list = false;
  Arguments parser("scene", "Write a built-in scene as an OBJ file, its materials beside it.",
                   "Example: hrad scene classroom -o classroom.obj");
  parser.add_positional("NAME", &name, "The name of a built-in scene", false);
  files.add_to(&parser, "scene");
  parser.add_flag("--list", &list, "Print the names of the built-in scenes");
  if (!parser.parse(arguments, &output->text())) return 0;
  if (!launcher::start(launcher::Choice::automatic, launcher::Work::of_the_first)) return 0;

  if (list) {
    if (!name.empty() || !files.paths().empty())
      fail_usage("scene", "--list takes neither a name nor -o");
    for (int64_t i = 0; hrad_scene_name(i) != nullptr; ++i)
      *output << std::string(hrad_scene_name(i)) + "\n";
    return 0;
  }
  if (name.empty()) fail_usage("scene", "NAME or --list is missing");
  if (files.paths().empty()) fail_usage("scene", "-o FILE.obj is missing");
  if (!is_builtin_scene(name))
    throw Failure(exit_scene, "there is no built-in scene '" + name + "'",
                  "built-in scenes: " + builtin_scene_names());
  files.check("");

  Session session{RunOptions()};
  check(hrad_make_scene(session.solver(), name.c_str()));
  files.write(&session);
  return 0;
}

}  // namespace hrad::cli
