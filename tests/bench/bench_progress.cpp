// How far the time that a solve says it has left is from what it takes, after a third of the run
// and later. README.md in this folder tells how to run it.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "bench/scene_bench.h"

using namespace bench;

namespace {

constexpr char kProgressUsage[] =
    "Usage: bench_progress [OPTION]... SCENE...\n"
    "  --set NAME=VALUE[,...]  settings of every solve (threads is 1 unless set)\n"
    "  --runs N                solves of each scene, whose median is printed (default 3)\n";

constexpr double looked_at[] = {1.0 / 3, 0.5, 0.67, 0.8};
constexpr size_t looks = sizeof looked_at / sizeof *looked_at;

struct Told {
  double seconds, left, fraction;
};

struct Guesses {
  bool done = false;
  char failure[256] = {};
  double seconds = 0, pause = 0;                   // of the solve, and the longest without a report
  double ratio[looks] = {}, fraction[looks] = {};  // told over true time left; share told
};

int32_t keep(const hrad_progress* progress, void* user) {
  static_cast<std::vector<Told>*>(user)->push_back(
      {progress->seconds, progress->seconds_left, progress->fraction});
  return 0;
}

Guesses guesses_of(const std::vector<Told>& told) {
  Guesses result;
  result.seconds = told.back().seconds;
  for (size_t k = 0; k < told.size(); ++k)
    result.pause = std::max(result.pause, told[k].seconds - (k > 0 ? told[k - 1].seconds : 0));
  for (size_t look = 0; look < looks; ++look) {
    const double at = looked_at[look] * result.seconds;
    size_t k = 0;
    while (k + 1 < told.size() && told[k + 1].seconds <= at) ++k;
    result.ratio[look] = told[k].left / (result.seconds - told[k].seconds);
    result.fraction[look] = told[k].fraction;
  }
  return result;
}

void measure(const std::string& scene, const Settings& settings, int runs, Guesses& result) {
  std::vector<Guesses> all;
  for (int run = 0; run < runs; ++run) {
    const auto solver = loaded(scene, settings);
    std::vector<Told> told;
    physics::ApiSolver::check(hrad_set_progress(solver->get(), keep, &told));
    solver->solve();
    all.push_back(guesses_of(told));
  }
  const auto median_of = [&](const auto& value) {
    std::vector<double> values;
    for (const Guesses& g : all) values.push_back(value(g));
    return median(values);
  };
  result.seconds = median_of([](const Guesses& g) { return g.seconds; });
  result.pause = median_of([](const Guesses& g) { return g.pause; });
  for (size_t look = 0; look < looks; ++look) {
    result.ratio[look] = median_of([&](const Guesses& g) { return g.ratio[look]; });
    result.fraction[look] = median_of([&](const Guesses& g) { return g.fraction[look]; });
  }
}

void print(const std::string& scene, const Guesses& g, double) {
  std::printf("| %s | %.2f | %.2f |", scene.c_str(), g.seconds, g.pause);
  for (size_t look = 0; look < looks; ++look)
    std::printf(" %.2f (%.0f %%) |", g.ratio[look], 100 * g.fraction[look]);
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  return exit_code_of("bench_progress", kProgressUsage, [&] {
    int runs = 3;
    const SceneOptions o = scene_options({argv + 1, argv + argc},
                                         [&](const std::string& name, const std::string& value) {
                                           if (name == "--runs")
                                             runs = static_cast<int>(number_in(name, value, 1));
                                           return name == "--runs";
                                         });
    std::printf("| scene | wall s | longest pause s |");
    for (double share : looked_at) std::printf(" told / true left at %.2f |", share);
    std::printf("\n|---|---|---|---|---|---|---|\n");
    for_each_scene<Guesses>(
        o.scenes,
        [&](const std::string& scene, Guesses& result) {
          measure(scene, o.settings, runs, result);
        },
        print);
  });
}
