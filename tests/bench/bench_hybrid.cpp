// The counterpart of the paper's Fig. 2c: the time of a solve on so many nodes with so many threads
// each, projected from what one rank after the other was measured to do, and what stands in the way
// of more. README.md in this folder tells how to run it and what the columns mean.
#include <cstdio>
#include <map>
#include <thread>

#include "bench/call_sites.h"
#include "bench/hybrid_options.h"
#include "bench/paper_table.h"
#include "support/replay.h"

using namespace bench;
using namespace hrad_test;

namespace {

long long whole(int64_t value) { return static_cast<long long>(value); }

bool counts(const std::string& stage) {
  return stage == "linking" || stage == "refine" || stage == "sweep";
}
bool is_initial(const std::string& stage) { return stage == kInitial; }

// Of each number of ranks, turn after turn, as the machine may be faster or slower for a while: of
// what each task took the least counts.
std::map<int, Solved> solve(const std::string& scene, const Settings& settings,
                            const std::vector<int>& ranks, int repeat) {
  std::map<int, Solved> solved;
  for (int turn = 0; turn < repeat; ++turn)
    for (int number : ranks) {
      Solved again = recorded_solve(scene, settings, number);
      if (turn == 0)
        solved[number] = std::move(again);
      else
        keep_the_least(solved[number].recording, again.recording);
    }
  return solved;
}

struct Work {
  double tasks = 0, stretches = 0;  // CPU seconds of all ranks together
  double largest = 0;               // of a rank, in tasks
  double longest = 0;               // of a task
  double imbalance(size_t ranks) const {
    return tasks > 0 ? largest * static_cast<double>(ranks) / tasks : 1;
  }
};

Work work_of(const std::vector<Timeline>& ranks) {
  Work work;
  for (const Timeline& events : ranks) {
    double own = 0;
    for (const Event& event : events) {
      work.stretches += event.seconds;
      for (double seconds : event.tasks) {
        own += seconds;
        work.longest = std::max(work.longest, seconds);
      }
    }
    work.tasks += own;
    work.largest = std::max(work.largest, own);
  }
  return work;
}

void print_table(const std::string& scene, const std::map<int, Solved>& solved,
                 const HybridOptions& o, const Settings& settings) {
  const double one = replay(events_of(solved.at(1).recording, counts), Machine{}).seconds;
  const double paper_one = paper_seconds(scene, 1, 1);
  std::printf(
      "| nodes | threads | s | speed-up | linking | refine | sweep | initial | paper s | paper "
      "speed-up |%s\n|---|---|---|---|---|---|---|---|---|---|%s\n",
      o.measure ? " measured wall s |" : "", o.measure ? "---|" : "");
  for (int nodes : o.nodes) {
    const Recording& recording = solved.at(nodes).recording;
    const std::vector<Timeline> all = events_of(recording, counts);
    const std::vector<Timeline> initial = events_of(recording, is_initial);
    for (int threads : o.threads) {
      Machine machine;
      machine.threads = threads;
      machine.wake = o.wake;
      const Replayed r = replay(all, machine);
      const auto stage = [&](const char* name) {
        double seconds = 0;
        for (const auto& [number, part] : r.of_stage)
          if (recording.stages[static_cast<size_t>(number)] == name) seconds += part;
        return seconds;
      };
      std::printf("| %d | %d | %.4f | %.2f | %.4f | %.4f | %.4f | %.4f |", nodes, threads,
                  r.seconds, one / r.seconds, stage("linking"), stage("refine"), stage("sweep"),
                  replay(initial, machine).seconds);
      const double paper = paper_seconds(scene, nodes, threads);
      if (paper > 0)
        std::printf(" %.2f | %.2f |", paper, paper_one / paper);
      else
        std::printf(" | |");
      const bool fits =
          static_cast<unsigned>(nodes * threads) <= std::thread::hardware_concurrency();
      if (o.measure && fits) {
        double least = 1e300;
        for (int turn = 0; turn < o.repeat; ++turn)
          least = std::min(least, wall_of_solve(scene, settings, nodes, threads));
        std::printf(" %.4f |", least);
      } else if (o.measure) {
        std::printf(" |");
      }
      std::printf("\n");
    }
  }
}

// CPU seconds, number and longest of the tasks at one place.
struct Loops {
  double seconds = 0, longest = 0;
  int64_t loops = 0, tasks = 0;
  std::map<size_t, double> of_rank;
  double imbalance(size_t ranks) const {
    double largest = 0;
    for (const auto& [rank, own] : of_rank) largest = std::max(largest, own);
    return seconds > 0 ? largest * static_cast<double>(ranks) / seconds : 1;
  }
};

std::map<std::string, Loops> loops_of(const std::vector<Timeline>& ranks, const CallSites& sites) {
  std::map<std::string, Loops> all;
  for (size_t rank = 0; rank < ranks.size(); ++rank)
    for (const Event& event : ranks[rank]) {
      if (event.kind != Kind::loop) continue;
      Loops& loops = all[sites.name(event.site)];
      ++loops.loops;
      loops.tasks += static_cast<int64_t>(event.tasks.size());
      for (double seconds : event.tasks) {
        loops.seconds += seconds;
        loops.of_rank[rank] += seconds;
        loops.longest = std::max(loops.longest, seconds);
      }
    }
  return all;
}

// Where the work is, and where ranks together do more of it than one alone.
void print_loops(const Recording& one, const Recording& many, const HybridOptions& o) {
  const auto alone = loops_of(events_of(one, counts), CallSites(one.sites));
  const auto together = loops_of(events_of(many, counts), CallSites(many.sites));
  std::vector<std::pair<double, std::string>> order;
  for (const auto& [name, loops] : together) order.emplace_back(-loops.seconds, name);
  std::sort(order.begin(), order.end());
  const int64_t ranks = static_cast<int64_t>(many.ranks.size());
  std::printf(
      "| tasks of one rank, s | of all %lld | imbalance | loops | tasks | of a rank | longest ms | "
      "where |\n"
      "|---|---|---|---|---|---|---|---|\n",
      whole(ranks));
  for (size_t k = 0; k < order.size() && k < static_cast<size_t>(o.top); ++k) {
    const std::string& name = order[k].second;
    const Loops& all = together.at(name);
    const auto at = alone.find(name);
    const Loops own = at == alone.end() ? Loops{} : at->second;
    std::printf("| %.4f | %.4f | %.2f | %lld | %lld | %lld | %.2f | %s |\n", own.seconds,
                all.seconds, all.imbalance(many.ranks.size()), whole(own.loops), whole(own.tasks),
                whole(all.tasks / ranks), 1e3 * all.longest, name.c_str());
  }
}

// The parts of the critical path that cost most beyond an even share of their work.
void print_critical(const Recording& recording, int threads, const HybridOptions& o) {
  const std::vector<Timeline> ranks = events_of(recording, counts);
  Machine machine;
  machine.threads = threads;
  machine.wake = o.wake;
  const Replayed replayed = replay(ranks, machine);
  const CallSites sites(recording.sites);
  const double lanes = static_cast<double>(ranks.size()) * threads;
  struct Row {
    const char* what;
    double seconds = 0, even = 0;
  };
  std::map<std::string, Row> rows;
  double serial = 0, network = 0, even = 0;
  for (const auto& [part, seconds] : replayed.critical) {
    const bool is_serial = part.kind == Kind::serial, is_loop = part.kind == Kind::loop;
    const std::string where = is_serial ? sites.between(part.from, part.to) : sites.name(part.from);
    Row& row = rows[(is_serial ? "1" : is_loop ? "2" : "3") + where];
    row.what = is_serial ? "one thread" : is_loop ? "tasks" : "network";
    row.seconds += seconds;
    serial += is_serial ? seconds : 0;
    network += is_serial || is_loop ? 0 : seconds;
  }
  int64_t count = 0, tasks = 0;
  for (const auto& [name, loops] : loops_of(ranks, sites)) {
    count += loops.loops;
    tasks += loops.tasks;
    const double share = loops.seconds / lanes;
    even += share;
    const auto at = rows.find("2" + name);
    if (at != rows.end()) at->second.even = share;
  }
  std::vector<std::pair<double, std::string>> order;
  for (const auto& [name, row] : rows) order.emplace_back(row.even - row.seconds, name);
  std::sort(order.begin(), order.end());
  const double all = replayed.seconds;
  std::printf(
      "critical path on %zu x %d: %.4f s = %.1f %% tasks shared evenly + %.1f %% uneven tasks + "
      "%.1f %% stretches on one thread + %.1f %% network; %lld loops of %lld tasks a rank\n",
      ranks.size(), threads, all, 100 * even / all, 100 * (all - even - serial - network) / all,
      100 * serial / all, 100 * network / all, whole(count / static_cast<int64_t>(ranks.size())),
      whole(count > 0 ? tasks / count : 0));
  machine.cut_at_will = true;
  std::printf("with tasks cut at will %.4f s, with ranks evenly loaded too %.4f s\n",
              replay(ranks, machine).seconds, even + serial + network);
  std::printf("| lost s | %% | on the path s | what | where |\n|---|---|---|---|---|\n");
  for (size_t k = 0; k < order.size() && k < static_cast<size_t>(o.top); ++k) {
    const Row& row = rows.at(order[k].second);
    std::printf("| %.5f | %.1f | %.5f | %s | %s |\n", row.seconds - row.even,
                100 * (row.seconds - row.even) / all, row.seconds, row.what,
                order[k].second.substr(1).c_str());
  }
}

void print_balance(const char* partition, const Solved& solved, double tasks_of_one) {
  const std::vector<Timeline> ranks = events_of(solved.recording, counts);
  const Work work = work_of(ranks);
  std::printf(
      "partition %s on %zu: imbalance %.3f (largest over mean of tasks' CPU), tasks %.3f s (%.3f "
      "of "
      "one rank's), stretches %.3f s, longest task %.1f ms; own of each rank:",
      partition, ranks.size(), work.imbalance(ranks.size()), work.tasks,
      tasks_of_one > 0 ? work.tasks / tasks_of_one : 0, work.stretches, 1e3 * work.longest);
  for (const Timeline& events : ranks) std::printf(" %.3f", work_of({events}).tasks);
  std::printf("\n");
}

void print_counts(int ranks, const hrad::Stats& s) {
  std::printf(
      "%d ranks: %lld rays, %lld pairs, %lld links, %lld leaves; R %lld messages %lld bytes, U "
      "%lld "
      "%lld, T %lld %lld; links %.2f MB, nodes %.2f MB of the largest rank; %lld rounds, %lld "
      "sweeps\n",
      ranks, whole(s.rays), whole(s.pairs), whole(s.links), whole(s.leaves), whole(s.messages[0]),
      whole(s.message_bytes[0]), whole(s.messages[1]), whole(s.message_bytes[1]),
      whole(s.messages[2]), whole(s.message_bytes[2]), 1e-6 * static_cast<double>(s.link_bytes),
      1e-6 * static_cast<double>(s.node_bytes), whole(s.rounds), whole(s.iterations));
}

void project(const std::string& scene, const std::string& linking, const HybridOptions& o) {
  const Settings settings = settings_of(scene, linking, o);
  std::printf("\n## %s, %s", scene.c_str(), linking.c_str());
  for (const auto& [name, value] : settings) std::printf(", %s=%s", name.c_str(), value.c_str());
  std::printf("\n\n");
  const std::map<int, Solved> solved = solve(scene, settings, o.nodes, o.repeat);
  print_table(scene, solved, o, settings);
  std::printf("\n");
  const int most = solved.rbegin()->first;
  const Work one = work_of(events_of(solved.at(1).recording, counts));
  print_counts(1, solved.at(1).stats);
  if (most > 1) print_counts(most, solved.at(most).stats);
  print_balance(o.partition.c_str(), solved.at(1), one.tasks);
  if (most > 1) print_balance(o.partition.c_str(), solved.at(most), one.tasks);
  if (most > 1 && o.other_partition) {
    const std::string other = o.partition == "grid" ? "cost" : "grid";
    Settings others = settings;
    others.emplace_back("partition", other);
    print_balance(other.c_str(), solve(scene, others, {most}, 1).at(most), one.tasks);
  }
  print_loops(solved.at(1).recording, solved.at(most).recording, o);
  const int threads = std::min(8, *std::max_element(o.threads.begin(), o.threads.end()));
  print_critical(solved.at(1).recording, threads, o);
  if (most > 1) print_critical(solved.at(most).recording, threads, o);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const HybridOptions o = hybrid_options_in({argv + 1, argv + argc});
    for (const std::string& scene : o.scenes)
      for (const std::string& linking : o.linkings) project(scene, linking, o);
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "bench_hybrid: %s\n%s", error.what(), kHybridUsage);
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_hybrid: %s\n", error.what());
    return 1;
  }
  return 0;
}
