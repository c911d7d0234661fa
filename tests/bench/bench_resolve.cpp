// Solving again for a new light, measured: links a second of a sweep, user CPU of a re-solve
// against the first solve, memory of nodes and links. README.md in this folder tells how to run it.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "bench/calibration.h"
#include "bench/paper_options.h"
#include "bench/solve_apart.h"

using namespace bench;

namespace {

constexpr char kResolveUsage[] =
    "Usage: bench_resolve [OPTION]... SCENE...\n"
    "  --set NAME=VALUE[,...]  settings of every solve (threads is 1 unless set)\n"
    "  --resolves N            re-solves of each scene (default 20)\n";

struct ResolveOptions {
  std::vector<std::string> scenes;
  Settings settings;
  int resolves = 20;
};

struct Resolves {
  bool done = false;
  char failure[256] = {};
  hrad_stats stats = {};  // after the first solve
  double first = 0;       // user CPU, as all that follows
  double median = 0, fastest = 0;
  double sweeps = 0;  // of each re-solve
};

double per(double value, double by) { return by > 0 ? value / by : 0; }
double real(int64_t count) { return static_cast<double>(count); }

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

void measure(const std::string& scene, const ResolveOptions& o, Resolves& result) {
  const auto solver = loaded(scene, o.settings);
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
  for (int k = 0; k < o.resolves; ++k) {
    for (double& e : emission) e *= k % 2 == 0 ? 2 : 0.5;
    physics::ApiSolver::check(hrad_set_emission(solver->get(), 0, solver->size(), emission.data()));
    start = user_seconds();
    solver->solve();
    seconds.push_back(user_seconds() - start);
  }
  result.sweeps = per(real(solver->stats().iterations - result.stats.iterations), o.resolves);
  result.median = median(seconds);
  result.fastest = *std::min_element(seconds.begin(), seconds.end());
}

void print(const std::string& scene, const Resolves& r, double calibration) {
  const hrad_stats& s = r.stats;
  const double swept = real(s.links) * r.sweeps;
  std::printf("%s, %lld patches, %lld elements, %lld links; calibration loop %.3f s\n",
              scene.c_str(), static_cast<long long>(s.patches), static_cast<long long>(s.elements),
              static_cast<long long>(s.links), calibration);
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

ResolveOptions options_of(const std::vector<std::string>& arguments) {
  ResolveOptions o;
  for (size_t i = 0; i < arguments.size(); ++i) {
    const std::string& a = arguments[i];
    const bool has_value = i + 1 < arguments.size();
    if (a == "--set" && has_value)
      o.settings = settings_in(arguments[++i]);
    else if (a == "--resolves" && has_value)
      o.resolves = static_cast<int>(number_in(a, arguments[++i], 1));
    else if (a[0] == '-')
      throw std::invalid_argument("unknown option or no value: " + a);
    else
      o.scenes.push_back(a);
  }
  if (o.scenes.empty()) throw std::invalid_argument("no scene named");
  return o;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const ResolveOptions o = options_of({argv + 1, argv + argc});
    for (const std::string& scene : o.scenes) {
      double calibration = calibration_seconds();
      const Resolves r = in_child<Resolves>([&](Resolves& result) { measure(scene, o, result); });
      calibration = (calibration + calibration_seconds()) / 2;
      print(scene, r, calibration);
    }
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "bench_resolve: %s\n%s", error.what(), kResolveUsage);
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_resolve: %s\n", error.what());
    return 1;
  }
  return 0;
}
