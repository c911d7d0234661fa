// The promise of `accuracy` on the built-in scene furnished-room, held against path tracing: patch
// means by the definition, bias, and the error at random points beside it.
#include "physics/comparison.h"
#include "support/check.h"

using namespace physics;

namespace {

constexpr int64_t kPatchPaths = 8000000, kPoints = 10000;

struct Case {
  const char* linking;
  double accuracy;
};
constexpr Case kCases[] = {{"rows", 0.05},  {"rows", 0.02},     {"rows", 0.01},    {"pairs", 0.05},
                           {"pairs", 0.02}, {"clusters", 0.05}, {"clusters", 0.02}};

void accuracy_is_kept() {
  ApiSolver loaded;
  loaded.make("furnished-room");
  const MonteCarlo reference(loaded.surfaces(), 20240607);
  const PatchReference patches(reference, kPatchPaths);
  const PointReference points(reference, kPoints, 8, 48, 99);
  for (const Case& c : kCases) {
    const double accuracy = c.accuracy;
    ApiSolver solver;
    solver.make("furnished-room");
    solver.set("linking", c.linking);
    solver.set("accuracy", accuracy);
    CHECK_EQUAL(solver.solve(), HRAD_OK);
    const Comparison at_patches = patches.compare(solver, reference);
    const Comparison at_points = points.compare(solver, reference);
    const hrad_stats stats = solver.stats();
    std::printf(
        "furnished-room by %s at %g: %lld leaves, %lld links, %.2f s; own estimate %.3f %% +- "
        "%.3f\n",
        c.linking, accuracy, static_cast<long long>(stats.leaves),
        static_cast<long long>(stats.links), stats.cpu_seconds, 100 * stats.error_estimate,
        100 * stats.error_standard_error);
    at_patches.print("  patch means");
    at_points.print("  points");
    // The reference is good enough to tell.
    CHECK(at_patches.noise < accuracy / 4);
    CHECK(at_patches.rms <= accuracy + 2 * at_patches.standard_error);
    CHECK(std::fabs(at_patches.bias) <= accuracy);
    // Points carry no promise, but are of the same order.
    CHECK(at_points.rms <= 4 * accuracy + 0.05);
    CHECK(at_points.disagreeing * 200 <= at_points.count);
    // The solver's own estimate doesn't hide its error.
    CHECK(stats.error_estimate < 0 ||
          at_patches.rms <= stats.error_estimate + 3 * stats.error_standard_error + 0.005);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(accuracy_is_kept)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
