// hrad partition: what a cluster would have to do, before it is booked. CLI: public headers only.
#include <algorithm>
#include <iterator>

#include "command.h"
#include "exit_code.h"
#include "json.h"
#include "numbers.h"
#include "output_files.h"
#include "run_options.h"
#include "session.h"
#include "text_table.h"

namespace hrad::cli {
namespace {

constexpr const char* methods[] = {"cost", "grid"};
constexpr int digits = 4;

struct Plan {
  std::string method;
  std::vector<hrad_rank_load> loads;  // per rank
  double mean_work() const;
  double imbalance() const;  // the largest work over the mean
  double remote() const;     // of all light, by work
};

double volume_of(const hrad_rank_load& load) {
  double volume = 1;
  for (int axis = 0; axis < 3; ++axis) volume *= load.upper[axis] - load.lower[axis];
  return volume;
}

double Plan::mean_work() const {
  double sum = 0;
  for (const hrad_rank_load& load : loads) sum += load.work;
  return sum / static_cast<double>(loads.size());
}

double Plan::imbalance() const {
  double largest = 0;
  for (const hrad_rank_load& load : loads) largest = std::max(largest, load.work);
  return mean_work() > 0 ? largest / mean_work() : 1;
}

double Plan::remote() const {
  double sum = 0, work = 0;
  for (const hrad_rank_load& load : loads) {
    sum += load.work * load.remote;
    work += load.work;
  }
  return work > 0 ? sum / work : 0;
}

Plan make_plan(Session* session, const std::string& method, int32_t ranks) {
  Plan plan{method, std::vector<hrad_rank_load>(static_cast<size_t>(ranks))};
  plan.loads[0].struct_size = sizeof(hrad_rank_load);
  check(hrad_plan_partition(session->solver(), method.c_str(), ranks, nullptr, plan.loads.data()));
  return plan;
}

std::string percent(double share) { return short_text(100 * share, 3) + " %"; }

void append_text(std::string* text, const Plan& plan, const std::string& unit) {
  *text += plan.method + ": imbalance " + short_text(plan.imbalance(), digits) +
           " (largest work over mean), " + percent(plan.remote()) +
           " of the light from other ranks\n";
  TextTable table("rrrrrr");
  table.add_row({"RANK", "PATCHES", "WORK", "OF MEAN", "VOLUME " + unit + "^3", "REMOTE"});
  for (size_t rank = 0; rank < plan.loads.size(); ++rank) {
    const hrad_rank_load& load = plan.loads[rank];
    const double mean = plan.mean_work();
    table.add_row({std::to_string(rank), std::to_string(load.patches),
                   short_text(load.work, digits), mean > 0 ? short_text(load.work / mean, 3) : "-",
                   short_text(volume_of(load), digits), percent(load.remote)});
  }
  *text += table.text();
}

void append_json(std::string* text, const std::string& scene, int64_t ranks,
                 const std::vector<Plan>& plans) {
  JsonWriter json(text);
  json.begin_object();
  json.field("scene", scene);
  json.field("ranks", ranks);
  json.begin_array("methods");
  for (const Plan& plan : plans) {
    json.begin_object();
    json.field("method", plan.method);
    json.field("imbalance", plan.imbalance());
    json.field("remote", plan.remote());
    json.begin_array("loads");
    for (const hrad_rank_load& load : plan.loads) {
      json.begin_object(JsonWriter::one_line);
      json.field("patches", load.patches);
      json.field("work", load.work);
      json.field("lower", load.lower, 3);
      json.field("upper", load.upper, 3);
      json.field("volume", volume_of(load));
      json.field("remote", load.remote);
      json.end();
    }
    json.end();
    json.end();
  }
  json.end();
  json.end();
}

int32_t ranks_of(const std::optional<std::string>& text) {
  if (!text) fail_usage("partition", "-n RANKS is missing");
  int64_t ranks = 0;
  if (!read_integer(*text, &ranks) || ranks < 1 || ranks > HRAD_MOST_RANKS)
    fail_usage("partition", "-n " + *text + ": a number of ranks from 1 to " +
                                std::to_string(HRAD_MOST_RANKS) + " is meant");
  return static_cast<int32_t>(ranks);
}

}  // namespace

int run_partition(const std::vector<std::string>& arguments, Output* output) {
  RunOptions options;
  OutputFiles files(OutputFiles::partitions);
  std::optional<std::string> ranks_text, method;
  bool as_json = false;
  Arguments parser(
      "partition", "Print what each of several ranks would get, without solving.",
      "Work is in rays, about, guessed from geometry and parameters. REMOTE is the "
      "share of\nlight from surfaces of other ranks, which takes messages. grid is the "
      "uniform grid of\nthe paper, cost halves of equal work.\n\n"
      "Example: hrad partition classroom -n 8 --method cost -o owners.vtu");
  options.add_to(&parser, "partition", RunOptions::a_scene);
  parser.add_option("-n,--ranks", "RANKS", &ranks_text, "How many ranks there would be");
  parser.add_option("--method", "cost|grid", &method, "One method only (both; -o takes cost)");
  files.add_to(&parser, "partition");
  parser.add_flag("--json", &as_json, "Print one JSON object instead of tables");
  if (!parser.parse(arguments, &output->text())) return 0;
  const int32_t ranks = ranks_of(ranks_text);
  if (method && std::find(std::begin(methods), std::end(methods), *method) == std::end(methods))
    fail_usage("partition", "--method " + *method + ": cost or grid is meant");
  if (!options.check()) return exit_done;
  files.check(options.scene_is_file() ? options.scene() : "");

  Session session(options);
  session.load();
  std::vector<Plan> plans;
  for (const char* name : methods)
    if (!method || *method == name) plans.push_back(make_plan(&session, name, ranks));
  for (const std::string& path : files.paths())
    check(
        hrad_export_partition(session.solver(), plans.front().method.c_str(), ranks, path.c_str()));
  if (as_json) {
    append_json(&output->text(), options.scene(), ranks, plans);
    return 0;
  }
  for (const Plan& plan : plans) append_text(&output->text(), plan, session.parameter("unit"));
  return 0;
}

}  // namespace hrad::cli
