// A checkpoint in words. Floor 8 (solver).
#include "base/error.h"
#include "base/number_text.h"
#include "solver/checkpoint.h"

namespace hrad {
namespace {

std::string stage_of(const CheckpointContent& content) {
  const SolveProgress& p = content.progress;
  if (!content.begun) return "not begun";
  if (!content.state) return "nothing is linked yet";
  if (p.finished || p.measuring_due) return content.stats.converged ? "converged" : "not converged";
  return p.sweeping ? "stopped between sweeps" : "stopped between rounds";
}

int64_t leaves_of(const Forest& forest) {
  int64_t leaves = 0;
  for (const Node& node : forest.nodes) leaves += !Forest::is_cluster(node) && node.first_child < 0;
  return leaves;
}

}  // namespace

std::string describe_checkpoint(const std::string& path) {
  const std::unique_ptr<CheckpointContent> content = read_checkpoint_file(path, 0);
  std::string text;
  const auto line = [&text](const std::string& name, const std::string& value) {
    text += name + ": " + value + "\n";
  };
  const auto count = [&line](const std::string& name, int64_t value) {
    line(name, number_text(value));
  };
  line("written by", content->origin);
  line("state", stage_of(*content));
  count("rounds", content->stats.rounds);
  count("iterations", content->stats.iterations);
  count("patches", content->scene.patch_count());
  if (content->state) {
    const State& state = *content->state;
    count("elements", static_cast<int64_t>(state.forest.nodes.size()));
    count("leaves", leaves_of(state.forest));
    count("links", state.links.link_count() + state.direct.mean.link_count() +
                       static_cast<int64_t>(state.direct.links.size()));
  }
  for (const auto& [name, bytes] : content->section_bytes) count("bytes of " + name, bytes);
  return text;
}

}  // namespace hrad
