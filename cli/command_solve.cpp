// hrad solve. CLI: public headers only.
#include "checkpointing.h"
#include "command.h"
#include "exit_code.h"
#include "output_files.h"
#include "run_options.h"
#include "session.h"
#include "solve_report.h"

namespace hrad::cli {
namespace {

constexpr const char* notes =
    "Powers are in W per band. When the accuracy is not reached within max_iterations,\n"
    "the results are written and the exit code is 7.\n"
    "\n"
    "With --checkpoint, SIGINT, SIGTERM and SIGUSR1 stop the solve with a checkpoint and the exit\n"
    "code 75, as the time limit does; the same command with --restart auto goes on. A second\n"
    "SIGINT or SIGTERM stops at once. SIGUSR2 writes a checkpoint and goes on. A solve that goes\n"
    "on repeats some seconds at the most.\n"
    "\n"
    "Examples: hrad solve room.obj --accuracy 0.01 -o room.vtu -o room.csv\n"
    "          hrad solve room.obj --checkpoint room.hrad --restart auto --time-limit 1:55:00";

}  // namespace

int run_solve(const std::vector<std::string>& arguments, Output* output) {
  RunOptions options;
  OutputFiles files(OutputFiles::results);
  CheckpointOptions checkpoints;
  bool as_json = false;
  Arguments parser("solve", "Solve a scene, print a summary, write the result.", notes);
  options.add_to(&parser, "solve", RunOptions::a_scene_to_solve);
  files.add_to(&parser, "solve");
  checkpoints.add_to(&parser);
  parser.add_flag("--json", &as_json, "Print one JSON object instead of the summary");
  if (!parser.parse(arguments, &output->text())) return 0;
  if (!options.check()) return exit_done;
  files.check(options.scene_is_file() ? options.scene() : "");
  const CheckpointPlan plan = checkpoints.check(options, files);

  Session session(options, true);
  Checkpointing checkpointing(&session, plan);
  try {
    session.load();
    checkpointing.begin();
    const int code = checkpointing.solve();
    // What the checkpoint has no room for may be written elsewhere.
    const double seconds_output = files.write(&session);
    const SolveReport report =
        make_report(&session, options.scene(), code, files.paths(), seconds_output);
    (as_json ? append_json : append_summary)(&output->text(), report);
    checkpointing.check_end();
    return code;
  } catch (const Interrupted& interrupted) {
    checkpointing.end_by_signal(interrupted.signal);
    throw;
  }
}

}  // namespace hrad::cli
