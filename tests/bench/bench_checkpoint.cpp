// What a checkpoint costs, measured: bytes of a link and of a leaf in the file, beside what they
// take in memory and what plain zlib makes of that; user CPU of a write, against that of the solve.
// README.md in this folder tells how to run it.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/scene_bench.h"
#include "solver/checkpoint.h"
#include "solver/checkpoint_codec.h"
#include "solver/solver.h"
#include "support/folder.h"

using namespace bench;

namespace {

constexpr char kCheckpointUsage[] =
    "Usage: bench_checkpoint [OPTION]... SCENE...\n"
    "  --set NAME=VALUE[,...]  settings of every solve (threads is 1 unless set)\n"
    "  --writes N              writes of each solution (default 9)\n"
    "  --interval S            seconds from one checkpoint to the next (default 600)\n";

struct CheckpointOptions : SceneOptions {
  int writes = 9;
  double interval = 600;
};

enum Part { links, leaves, rest, parts };  // the rest: scene, parameters, progress

struct Cost {
  double user = 0, wall = 0;  // seconds, medians
  int64_t bytes = 0;
};

struct Costs {
  bool done = false;
  char failure[256] = {};
  hrad::Stats stats;
  double solve = 0;  // user CPU
  Cost at_the_end, in_linking;
  int64_t memory[parts] = {}, by_zlib[parts] = {}, in_file[parts] = {};
};

Cost cost_of_writing(hrad::Solver& solver, const std::string& path, int writes) {
  std::vector<double> user, wall;
  for (int k = 0; k < writes; ++k) {
    const auto start = std::chrono::steady_clock::now();
    const double before = user_seconds();
    solver.write_checkpoint(path);
    user.push_back(user_seconds() - before);
    wall.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return {median(user), median(wall), static_cast<int64_t>(std::filesystem::file_size(path))};
}

// Arrays as they lie in memory, one after the other, and what zlib makes of each.
class Plain {
 public:
  Plain(Costs& costs, Part part) : memory_(costs.memory[part]), by_zlib_(costs.by_zlib[part]) {}

  template <class Array>
  void add(const Array& array) {
    add(std::string(reinterpret_cast<const char*>(array.data()),
                    array.size() * sizeof *array.data()));
  }
  // Less the places of families, which follow from their parents.
  void add(const hrad::NodeArray& nodes) {
    std::string bytes(reinterpret_cast<const char*>(nodes.stems()),
                      nodes.size() * sizeof(hrad::Stem));
    for (size_t k = nodes.first_element(); k < nodes.size(); k += 4) {
      const hrad::NodeId parent = nodes[k].parent;
      bytes.append(reinterpret_cast<const char*>(&parent), sizeof parent);
    }
    add(bytes);
  }
  void add(const hrad::LinkTable& table) {
    std::string bytes;
    for (size_t k = 0; k < table.size(); ++k) {
      const auto run = table[k].links();
      bytes.append(reinterpret_cast<const char*>(run.begin()), run.size() * sizeof(hrad::Link));
    }
    add(bytes);
  }

 private:
  void add(const std::string& bytes) {
    memory_ += static_cast<int64_t>(bytes.size());
    by_zlib_ += static_cast<int64_t>(hrad::compressed(bytes).size());
  }

  int64_t &memory_, &by_zlib_;
};

void weigh(const hrad::CheckpointContent& content, Costs& costs) {
  const hrad::State& state = *content.state;
  Plain of_links(costs, links), of_leaves(costs, leaves), of_rest(costs, rest);
  of_links.add(state.links);
  of_links.add(state.direct.mean);
  of_links.add(state.direct.links);
  of_leaves.add(state.forest.nodes);
  of_leaves.add(state.forest.clusters.clusters);
  of_leaves.add(state.cells);
  const hrad::LeafPoints& points = state.direct.of_leaf;
  std::vector<hrad::LeafPoints::Numbers> numbers;
  std::vector<hrad::LeafPoints::Places> places;
  for (size_t k = 0; k < points.size(); ++k) numbers.push_back(points[k]);
  for (size_t k = 0; k < points.own_count(); ++k) places.push_back(points.own(k));
  of_leaves.add(numbers);
  of_leaves.add(state.direct.first);
  of_leaves.add(places);
  of_leaves.add(state.radiosity);
  of_leaves.add(state.irradiance);
  of_rest.add(content.scene.vertices);
  of_rest.add(content.scene.corners);
  of_rest.add(content.scene.material);
  of_rest.add(content.scene.face);
  of_rest.add(content.scene.flags);
  of_rest.add(content.scene.emission);
  of_rest.add(content.scene.reflectance);
  const auto is_one_of = [](const std::string& name, std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const auto& [name, bytes] : content.section_bytes) {
    const Part part =
        is_one_of(name, {"links", "mean", "ptlinks"})                                       ? links
        : is_one_of(name, {"tree", "nodes", "clusters", "cells", "points", "own", "light"}) ? leaves
                                                                                            : rest;
    costs.in_file[part] += bytes;
  }
}

void load(hrad::Solver& solver, const std::string& scene, const Settings& settings) {
  solver.set_int("threads", 1);
  for (const auto& [name, value] : settings) solver.set_text(name, value);
  const bool is_file = std::filesystem::path(scene).extension() == ".obj";
  is_file ? solver.load_scene(scene) : solver.make_scene(scene);
}

void measure(const std::string& scene, const CheckpointOptions& o, Costs& costs) {
  const hrad_test::Folder folder("bench");
  {
    hrad::Solver solver;
    load(solver, scene, o.settings);
    const double start = user_seconds();
    solver.solve();
    costs.solve = user_seconds() - start;
    costs.at_the_end = cost_of_writing(solver, folder.file("end.hrad"), o.writes);
    costs.stats = solver.stats();
  }
  weigh(*hrad::read_checkpoint_file(folder.file("end.hrad"), 0), costs);
  // Half way through linking, as a solve that lasts does it.
  hrad::Solver solver;
  load(solver, scene, o.settings);
  solver.set_int("resumable", 1);
  solver.set_progress([&](const hrad::Progress& progress) {
    if (progress.stage != std::string("linking") || progress.stage_share < 0.5) return true;
    try {
      costs.in_linking = cost_of_writing(solver, folder.file("linking.hrad"), o.writes);
    } catch (const hrad::Error& error) {
      if (error.status() != hrad::Status::state) throw;
      return true;  // nothing to write yet
    }
    return false;
  });
  static_cast<void>(solver.solve());
}

void print(const std::string& scene, const CheckpointOptions& o, const Costs& c, double loop) {
  const auto links_there = static_cast<double>(c.stats.links),
             leaves_there = static_cast<double>(c.stats.leaves);
  const auto whole = [](const int64_t(&of)[parts]) {
    return 1e-6 * static_cast<double>(of[links] + of[leaves] + of[rest]);
  };
  const auto each = [](int64_t bytes, double count) {
    return per(static_cast<double>(bytes), count);
  };
  std::printf("%s, %s: %lld links, %lld leaves; calibration loop %.3f s\n", scene.c_str(),
              text_of(o.settings).c_str(), static_cast<long long>(c.stats.links),
              static_cast<long long>(c.stats.leaves), loop);
  std::printf("                 memory      zlib      file\n");
  std::printf("  bytes a link   %6.1f    %6.1f    %6.2f\n", each(c.memory[links], links_there),
              each(c.by_zlib[links], links_there), each(c.in_file[links], links_there));
  std::printf("  bytes a leaf   %6.1f    %6.1f    %6.2f\n", each(c.memory[leaves], leaves_there),
              each(c.by_zlib[leaves], leaves_there), each(c.in_file[leaves], leaves_there));
  std::printf("  all, MB        %6.1f    %6.1f    %6.2f\n", whole(c.memory), whole(c.by_zlib),
              1e-6 * static_cast<double>(c.at_the_end.bytes));
  std::printf("  solve          %.3f s of user CPU, %.2f loops\n", c.solve, c.solve / loop);
  const auto print_cost = [](const char* when, const Cost& cost) {
    std::printf("  %s %.3f s of user CPU, %.3f s by the clock, %.2f MB\n", when, cost.user,
                cost.wall, 1e-6 * static_cast<double>(cost.bytes));
  };
  print_cost("a write       ", c.at_the_end);
  if (c.in_linking.bytes > 0) print_cost("  in linking  ", c.in_linking);
  const double share_of_one = 100 * per(c.at_the_end.user, c.solve),
               share = 100 * per(c.at_the_end.user, o.interval);
  std::printf("  share          %.2f %% of the solve for one, %.3f %% at one in %g s\n",
              share_of_one, share, o.interval);
  std::printf("| %s | %.2f | %.2f | %.1f | %.1f | %.1f | %.2f | %.3f | %.2f | %.3f |\n",
              scene.c_str(), each(c.in_file[links], links_there),
              each(c.in_file[leaves], leaves_there), whole(c.memory), whole(c.by_zlib),
              1e-6 * static_cast<double>(c.at_the_end.bytes), c.solve, c.at_the_end.user,
              share_of_one, share);
  std::fflush(stdout);
}

CheckpointOptions options_of(const std::vector<std::string>& arguments) {
  CheckpointOptions o;
  static_cast<SceneOptions&>(o) =
      scene_options(arguments, [&](const std::string& name, const std::string& value) {
        if (name == "--writes")
          o.writes = static_cast<int>(number_in(name, value, 1));
        else if (name == "--interval")
          o.interval = number_in(name, value, 1);
        else
          return false;
        return true;
      });
  return o;
}

}  // namespace

int main(int argc, char** argv) {
  return exit_code_of("bench_checkpoint", kCheckpointUsage, [&] {
    const CheckpointOptions o = options_of({argv + 1, argv + argc});
    for_each_scene<Costs>(
        o.scenes, [&](const std::string& scene, Costs& costs) { measure(scene, o, costs); },
        [&](const std::string& scene, const Costs& costs, double calibration) {
          print(scene, o, costs, calibration);
        });
  });
}
