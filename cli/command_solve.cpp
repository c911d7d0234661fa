// hrad solve. CLI: public headers only.
#include "command.h"
#include "output_files.h"
#include "run_options.h"
#include "session.h"
#include "solve_report.h"

namespace hrad::cli {

int run_solve(const std::vector<std::string>& arguments, Output* output) {
  RunOptions options;
  OutputFiles files(OutputFiles::results);
  bool as_json = false;
  Arguments parser("solve", "Solve a scene, print a summary, write the result.",
                   "Powers are in W per band. When the accuracy is not reached within "
                   "max_iterations,\nthe results are written and the exit code is 7.\n\n"
                   "Example: hrad solve room.obj --accuracy 0.01 -o room.vtu -o room.csv");
  options.add_to(&parser, "solve", RunOptions::a_scene);
  files.add_to(&parser, "solve");
  parser.add_flag("--json", &as_json, "Print one JSON object instead of the summary");
  if (!parser.parse(arguments, &output->text())) return 0;
  options.check();
  files.check(options.scene_is_file() ? options.scene() : "");

  Session session(options);
  session.load();
  const int code = session.solve();
  const double seconds_output = files.write(&session);
  const SolveReport report =
      make_report(&session, options.scene(), code, files.paths(), seconds_output);
  (as_json ? append_json : append_summary)(&output->text(), report);
  return code;
}

}  // namespace hrad::cli
