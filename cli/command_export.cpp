// hrad export. CLI: public headers only.
#include "command.h"
#include "exit_code.h"
#include "output_files.h"
#include "run_options.h"
#include "session.h"

namespace hrad::cli {

int run_export(const std::vector<std::string>& arguments, Output* output) {
  RunOptions options;
  OutputFiles files(OutputFiles::results);
  Arguments parser("export", "Solve a scene and write the result.",
                   "Example: hrad export cornell --accuracy 0.05 -o cornell.csv");
  options.add_to(&parser, "export", RunOptions::a_scene_to_solve);
  files.add_to(&parser, "export");
  if (!parser.parse(arguments, &output->text())) return 0;
  if (files.paths().empty()) fail_usage("export", "-o FILE is missing");
  if (!options.check()) return exit_done;
  files.check(options.scene_is_file() ? options.scene() : "");

  Session session(options);
  session.load();
  const int code = session.solve();
  files.write(&session);
  return code;
}

}  // namespace hrad::cli
