// Reading them (checkpoint_options.h). CLI: public headers only.
#include "checkpoint_options.h"

#include "exit_code.h"
#include "launcher.h"
#include "numbers.h"

namespace hrad::cli {
namespace {

constexpr double seconds_of_a_minute = 60, largest_interval = 1e6;  // min, two years
constexpr int64_t most_kept = 1000, most_hours = 1000000;

double interval_of(const std::string& text) {
  double minutes = 0;
  if (!read_real(text, &minutes) || !(minutes > 0 && minutes <= largest_interval))
    fail_usage("solve", "--checkpoint-interval takes minutes, more than 0 and up to " +
                            real_text(largest_interval) + ", not '" + text + "'");
  return minutes * seconds_of_a_minute;
}

int64_t keep_of(const std::string& text) {
  int64_t number = 0;
  if (!read_integer(text, &number) || number < 0 || number > most_kept)
    fail_usage("solve", "--checkpoint-keep takes a number of files from 0 to " +
                            std::to_string(most_kept) + ", not '" + text + "'");
  return number;
}

double limit_of(const std::string& text) {
  int64_t part[3] = {-1, -1, -1};
  const auto parts = split(text, ':');
  bool right = parts.size() == 3;
  for (size_t i = 0; right && i < 3; ++i)
    right = read_integer(parts[i], &part[i]) && part[i] >= 0 && part[i] <= (i ? 59 : most_hours);
  const double seconds = right ? 3600.0 * static_cast<double>(part[0]) +
                                     60.0 * static_cast<double>(part[1]) +
                                     static_cast<double>(part[2])
                               : 0;
  if (!(seconds > 0))
    fail_usage("solve",
               "--time-limit takes H:M:S, as 1:30:00, and more than 0, not '" + text + "'");
  return seconds;
}

}  // namespace

void CheckpointOptions::add_to(Arguments* arguments) {
  arguments->add_option("--checkpoint", "FILE.hrad", &checkpoint_,
                        "Keep the solve so far in this file, so that it can go on after a stop");
  arguments->add_option("--checkpoint-interval", "MIN", &interval_,
                        "Minutes from one checkpoint to the next (10)");
  arguments->add_option("--checkpoint-keep", "N", &keep_,
                        "Older checkpoints kept as FILE.hrad.prev, .prev2 and so on (1)");
  arguments->add_option("--restart", "FILE.hrad|auto", &restart_,
                        "Go on from this file; auto: from that of --checkpoint, if there is one");
  arguments->add_option("--time-limit", "H:M:S", &time_limit_,
                        "Stop with a checkpoint after this time");
}

CheckpointPlan CheckpointOptions::check(const RunOptions& run, const OutputFiles& files) const {
  CheckpointPlan plan;
  plan.path = checkpoint_.value_or("");
  if (checkpoint_ && !is_checkpoint(plan.path))
    fail_usage("solve",
               "--checkpoint takes a file whose name ends with .hrad, not '" + plan.path + "'");
  if (interval_) plan.interval_seconds = interval_of(*interval_);
  if (keep_) plan.keep = keep_of(*keep_);
  if (time_limit_) plan.time_limit = limit_of(*time_limit_);
  for (const auto& [name, value] : run.parameters()) {
    if (name == "checkpoint_keep" && keep_)
      fail_usage("solve", "--checkpoint-keep and --set checkpoint_keep are one: give it once");
    if (name == "resumable") plan.resumable = false;
  }
  const struct {
    const char* name;
    bool given;
  } need_a_checkpoint[] = {{"--checkpoint-interval", interval_.has_value()},
                           {"--checkpoint-keep", keep_.has_value()},
                           {"--time-limit", time_limit_.has_value()},
                           {"--restart auto", restart_ == "auto"}};
  for (const auto& option : need_a_checkpoint)
    if (option.given && !checkpoint_)
      fail_usage("solve", std::string(option.name) + " needs --checkpoint FILE.hrad");
  if (restart_ && run.scene_is_checkpoint())
    fail_usage("solve", "'" + run.scene() + "' holds scene and state: --restart is for a scene");
  plan.restart_auto = restart_ == "auto";
  if (restart_ && !plan.restart_auto) {
    plan.restart = *restart_;
    if (plan.restart.empty()) fail_usage("solve", "--restart takes a file or 'auto'");
  }
  launcher::on_first([&] { check_files(plan, run, files); });
  return plan;
}

void CheckpointOptions::check_files(const CheckpointPlan& plan, const RunOptions& run,
                                    const OutputFiles& files) const {
  if (!plan.restart.empty()) files.check_other(plan.restart, "the file to go on from");
  if (!checkpoint_) return;
  if (run.scene_is_file() && same_file(plan.path, run.scene()))
    fail_usage("solve", "--checkpoint " + plan.path +
                            " would write over the input; to go on in one file: "
                            "hrad solve SCENE --checkpoint FILE.hrad --restart auto");
  files.check_other(plan.path, "the checkpoint");
  check_place(plan.path);
}

}  // namespace hrad::cli
