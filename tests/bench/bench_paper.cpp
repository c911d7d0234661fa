// What the library claims, measured: cost of whole solves (user CPU, rays, links, memory), error of
// patch means and at random points against path tracing, balance; and ratios of user CPU between
// two settings. README.md in this folder tells how to run it.
#include <algorithm>
#include <cstdio>

#include "bench/paper_options.h"

using namespace bench;

namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}
double smallest(const std::vector<double>& v) { return *std::min_element(v.begin(), v.end()); }
double greatest(const std::vector<double>& v) { return *std::max_element(v.begin(), v.end()); }

double per(int64_t bytes, int64_t count) {
  return count > 0 ? static_cast<double>(bytes) / static_cast<double>(count) : 0;
}
long long whole(int64_t value) { return static_cast<long long>(value); }

ReferencePlace place_of(const std::string& scene, const Options& o) {
  return {o.reference_dir, scene, o.points, o.sides, o.seed};
}

// Reads a scene's reference, adds samples for the time asked for, and writes it back.
void improve_reference(const std::string& scene, const Settings& settings, const Options& o) {
  const PathTracer tracer(loaded(scene, settings)->surfaces());
  const std::vector<Surface>& surfaces = tracer.surfaces();
  const ReferencePlace place = place_of(scene, o);
  const uint64_t key = place.key(surfaces);
  const std::string path = place.path(key);
  Reference reference;
  if (!read_reference(path, key, reference)) {
    reference.sides = side_targets(surfaces, o.sides, Random::mixed(o.seed));
    reference.points = point_targets(surfaces, o.points, Random::mixed(o.seed + 1));
  }
  const Sampler for_sides(tracer, o.seed, 0), for_points(tracer, o.seed, 1);
  constexpr double seconds_between_writes = 20;
  const double start = user_seconds();
  double written = start;
  while (user_seconds() - start < o.reference_seconds || !reference.usable()) {
    if (reference.sides.seconds < reference.points.seconds)
      for_sides.pass(reference.sides);
    else
      for_points.pass(reference.points);
    if (user_seconds() - written < seconds_between_writes) continue;
    write_reference(path, key, reference);
    written = user_seconds();
  }
  write_reference(path, key, reference);
  std::printf(
      "reference %s: %zu sides of patches, %lld passes, %.1f s, noise %.3f %%; %zu points, %lld "
      "passes, %.1f s, noise %.3f %%; %zu emitters; calibration loop %.3f s\n",
      path.c_str(), reference.sides.targets.size(), whole(reference.sides.passes),
      reference.sides.seconds, 100 * noise_of(reference.sides, tracer),
      reference.points.targets.size(), whole(reference.points.passes), reference.points.seconds,
      100 * noise_of(reference.points, tracer), tracer.emitter_count(), calibration_seconds());
  std::fflush(stdout);
}

void print_error(const char* what, const SolutionError& e) {
  const double noise_share = e.rms > 0 ? e.noise / e.rms : 0;
  std::printf(
      "  %-14s rms %.3f %% +- %.3f, bias %+.3f %% +- %.3f, n %lld; noise of the reference "
      "%.3f %% (%.2f of the rms)\n",
      what, 100 * e.rms, 100 * e.rms_error, 100 * e.bias, 100 * e.bias_error, whole(e.count),
      100 * e.noise, noise_share);
}

void print(const std::string& scene, const Settings& settings,
           const std::vector<Measurement>& runs) {
  const Measurement& m = runs.front();
  const hrad_stats& s = m.stats;
  std::vector<double> user, loops;
  for (const Measurement& r : runs) {
    user.push_back(r.user_seconds);
    loops.push_back(r.user_seconds / r.calibration);
  }
  std::printf("%s, %lld patches, %s%s\n", scene.c_str(), whole(s.patches),
              text_of(settings).c_str(), s.converged ? "" : ", NOT CONVERGED");
  std::printf(
      "  user CPU       %.3f s (median of %zu, %.3f to %.3f), %.2f calibration loops, %d threads\n",
      median(user), user.size(), smallest(user), greatest(user), median(loops), s.threads);
  std::printf("  wall           initial %.3f, linking %.3f, iterative %.3f s\n", s.seconds_initial,
              s.seconds_linking, s.seconds_iterative);
  std::printf("  work           %lld rays, %lld pairs, %lld rounds, %lld iterations\n",
              whole(s.rays), whole(s.pairs), whole(s.rounds), whole(s.iterations));
  std::printf("  hierarchy      %lld links, %lld leaves, %lld elements, %.1f links a leaf\n",
              whole(s.links), whole(s.leaves), whole(s.elements), per(s.links, s.leaves));
  std::printf("  memory         peak %.1f MB, %.2f bytes a link, %.1f bytes a node\n",
              1e-6 * static_cast<double>(s.memory_peak_bytes), per(s.link_bytes, s.links),
              per(s.node_bytes, s.elements));
  std::printf("  own estimate   %.3f %% +- %.3f\n", 100 * s.error_estimate,
              100 * s.error_standard_error);
  std::printf(
      "  balance        worst band off by %.4f %%; sealed %.3f %% of the area; %.3f %% of "
      "measuring rays met a black back\n",
      100 * m.mismatch, s.area > 0 ? 100 * s.sealed_area / s.area : 0, 100 * s.back_share);
  if (m.compared) {
    print_error("patch means", m.sides);
    print_error("points", m.points);
    std::printf(
        "  sealed points  %.3f %% of the area, left out; %lld points on which the two "
        "disagree\n",
        100 * m.points.sealed, whole(m.points.disagreeing));
  } else {
    std::printf("  no reference yet: --reference-seconds makes one\n");
  }
  std::printf("| %s | %s | %.2f | %.1f | %.2f | %lld | %lld | %.1f | %.0f | %.2f | ", scene.c_str(),
              text_of(settings).c_str(), median(user), median(loops),
              1e-6 * static_cast<double>(s.rays), whole(s.leaves), whole(s.links),
              per(s.link_bytes, s.links), 1e-6 * static_cast<double>(s.memory_peak_bytes),
              100 * s.error_estimate);
  if (m.compared)
    std::printf("%.2f +- %.2f | %+.2f | %.2f +- %.2f | %+.2f | ", 100 * m.sides.rms,
                100 * m.sides.rms_error, 100 * m.sides.bias, 100 * m.points.rms,
                100 * m.points.rms_error, 100 * m.points.bias);
  else
    std::printf("| | | | ");
  std::printf("%.3f |\n", 100 * m.mismatch);
  std::fflush(stdout);
}

// Solves with two settings in turn, the one that goes first alternating.
void compare(const std::string& scene, const Options& o) {
  const int64_t pairs = o.runs > 0 ? o.runs : 5;
  std::vector<double> user[2], ratios;
  for (int64_t i = 0; i < pairs; ++i) {
    double seconds[2];
    for (int64_t turn = 0; turn < 2; ++turn) {
      const size_t which = static_cast<size_t>((turn + i) % 2);
      seconds[which] = solve_apart(scene, joined(o.common, o.rivals[which]), nullptr).user_seconds;
      user[which].push_back(seconds[which]);
    }
    ratios.push_back(seconds[1] / seconds[0]);
  }
  const std::string names[2] = {text_of(o.rivals[0]), text_of(o.rivals[1])};
  std::printf("%s, %s, %lld pairs of solves\n", scene.c_str(), text_of(o.common).c_str(),
              whole(pairs));
  for (int i = 0; i < 2; ++i)
    std::printf("  user CPU       %.3f s (median, %.3f to %.3f), %s\n", median(user[i]),
                smallest(user[i]), greatest(user[i]), names[i].c_str());
  std::printf("  ratio          %.3f (median of the pairs, %.3f to %.3f), %s over %s\n",
              median(ratios), smallest(ratios), greatest(ratios), names[1].c_str(),
              names[0].c_str());
  for (double& r : ratios) r = 1 / r;
  std::printf("  ratio          %.3f (median of the pairs, %.3f to %.3f), %s over %s\n",
              median(ratios), smallest(ratios), greatest(ratios), names[0].c_str(),
              names[1].c_str());
  std::fflush(stdout);
}

void measure(const std::string& scene, const Options& o) {
  if (o.reference_seconds > 0)
    in_child<Measurement>(
        [&](Measurement&) { improve_reference(scene, joined(o.common, o.cases[0]), o); });
  if (o.reference_only) return;
  const ReferencePlace place = place_of(scene, o);
  for (const Settings& one : o.cases) {
    const Settings settings = joined(o.common, one);
    std::vector<Measurement> runs;
    for (int64_t i = 0; i < std::max<int64_t>(1, o.runs); ++i)
      runs.push_back(solve_apart(scene, settings, i == 0 ? &place : nullptr));
    print(scene, settings, runs);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options o = options_in({argv + 1, argv + argc});
    for (const std::string& scene : o.scenes)
      if (o.rivals.empty())
        measure(scene, o);
      else
        compare(scene, o);
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "bench_paper: %s\n%s", error.what(), kUsage);
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_paper: %s\n", error.what());
    return 1;
  }
  return 0;
}
