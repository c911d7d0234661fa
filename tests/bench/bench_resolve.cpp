// Solving again for a new light, measured: links a second of a sweep, user CPU of a re-solve
// against the first solve, memory of nodes and links. README.md in this folder tells how to run it.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "bench/scene_bench.h"

using namespace bench;

namespace {

constexpr char kResolveUsage[] =
    "Usage: bench_resolve [OPTION]... SCENE...\n"
    "  --set NAME=VALUE[,...]  settings of every solve (threads is 1 unless set)\n"
    "  --resolves N            re-solves of each scene (default 20)\n";

struct Resolves {
  bool done = false;
  char failure[256] = {};
  hrad_stats stats = {};  // after the first solve
  double first = 0;       // user CPU, as all that follows
  double median = 0, fastest = 0;
  double sweeps = 0;  // of each re-solve
};

double real(int64_t count) { return static_cast<double>(count); }

void measure(const std::string& scene, const Settings& settings, int resolves, Resolves& result) {
  const auto solver = loaded(scene, settings);
  double start = user_seconds();
  solver->solve();
  result.first = user_seconds() - start;
  result.stats = solver->stats();
  solver->set("refine", 0);
  const int64_t count = solver->size() * solver->bands();
  std::vector<double> emission(static_cast<size_t>(count));
  physics::ApiSolver::check(hrad_query_patches(solver->get(), HRAD_EMISSION, HRAD_FRONT, 0,
                                               solver->size(), emission.data()));
  std::vector<double> seconds;
  for (int k = 0; k < resolves; ++k) {
    for (double& e : emission) e *= k % 2 == 0 ? 2 : 0.5;
    physics::ApiSolver::check(hrad_set_emission(solver->get(), 0, solver->size(), emission.data()));
    start = user_seconds();
    solver->solve();
    seconds.push_back(user_seconds() - start);
  }
  result.sweeps = per(real(solver->stats().iterations - result.stats.iterations), resolves);
  result.median = median(seconds);
  result.fastest = *std::min_element(seconds.begin(), seconds.end());
}

void print(const std::string& scene, const Resolves& r, double calibration) {
  const hrad_stats& s = r.stats;
  const double swept = real(s.swept_links) * r.sweeps;
  std::printf("%s, %lld patches, %lld elements, %lld links swept of %lld; calibration loop %.3f s\n",
              scene.c_str(), static_cast<long long>(s.patches), static_cast<long long>(s.elements),
              static_cast<long long>(s.swept_links), static_cast<long long>(s.links), calibration);
  std::printf("  first solve    %.3f s of user CPU, %.2f loops\n", r.first, r.first / calibration);
  std::printf("  re-solve       %.4f s (median; fastest %.4f), %.3f loops, %.1f sweeps\n", r.median,
              r.fastest, r.median / calibration, r.sweeps);
  std::printf("  re-solve/solve %.2f %% (fastest %.2f %%)\n", 100 * per(r.median, r.first),
              100 * per(r.fastest, r.first));
  std::printf("  sweep          %.3f Glinks/s (fastest %.3f), %.3f Glinks a loop\n",
              1e-9 * per(swept, r.median), 1e-9 * per(swept, r.fastest),
              1e-9 * per(swept, r.median / calibration));
  std::printf("  memory         %.1f bytes a node, %.2f bytes a link, peak %.1f MB\n",
              per(real(s.node_bytes), real(s.elements)), per(real(s.link_bytes), real(s.links)),
              1e-6 * real(s.memory_peak_bytes));
  std::printf("| %s | %.2f | %.4f | %.2f | %.3f | %.1f | %.2f | %.1f | %.2f |\n", scene.c_str(),
              r.first, r.median, 100 * per(r.median, r.first), 1e-9 * per(swept, r.median),
              per(real(s.node_bytes), real(s.elements)), per(real(s.link_bytes), real(s.links)),
              1e-6 * real(s.memory_peak_bytes), r.median / calibration);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  return exit_code_of("bench_resolve", kResolveUsage, [&] {
    int resolves = 20;
    const SceneOptions o = scene_options({argv + 1, argv + argc},
                                         [&](const std::string& name, const std::string& value) {
                                           if (name == "--resolves")
                                             resolves = static_cast<int>(number_in(name, value, 1));
                                           return name == "--resolves";
                                         });
    for_each_scene<Resolves>(
        o.scenes,
        [&](const std::string& scene, Resolves& result) {
          measure(scene, o.settings, resolves, result);
        },
        print);
  });
}
