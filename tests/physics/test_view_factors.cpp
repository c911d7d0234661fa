// View factors out of the library against closed forms: an emitter with E = 1, and the irradiance
// that its receiver reports.
#include "physics/api_solver.h"
#include "physics/view_factors.h"
#include "support/check.h"

using namespace physics;

namespace {

// Mean irradiance of the receiver from an emitter with E = 1 that reflects nothing.
double solved_factor(const Polygon& receiver, const Polygon& emitter, const Polygon& blocker = {},
                     double reflectance = 0.5, double accuracy = 0.0005) {
  ApiSolver solver(1);
  solver.set("accuracy", accuracy);
  const int64_t first = solver.add(receiver, solver.add_material(gray(reflectance), gray(0)));
  const int64_t count = solver.size() - first;
  solver.add(emitter, solver.add_material(gray(0), gray(1)));
  if (!blocker.empty()) solver.add(blocker, solver.add_material(gray(0), gray(0), HRAD_BLOCKER));
  CHECK_EQUAL(solver.solve(), HRAD_OK);
  return solver.mean(HRAD_IRRADIANCE, first, count)[0];
}

void check_factor(const char* what, const Polygon& receiver, const Polygon& emitter, double exact,
                  double tolerance = 0.001, const Polygon& blocker = {}) {
  const double solved = solved_factor(receiver, emitter, blocker, 0.5, tolerance / 2);
  std::printf("%-26s %.7f exact %.7f  %+.4f %%\n", what, solved, exact, 100 * (solved / exact - 1));
  std::fflush(stdout);
  CHECK_NEAR(solved, exact, tolerance * exact);
}

const Polygon kFloor = parallelogram({0, 0, 0}, {1, 0, 0}, {0, 2, 0});

// In the plane z = height, looking down.
Polygon ceiling(Interval x, Interval y, double height) {
  return parallelogram({x.from, y.from, height}, {0, y.width(), 0}, {x.width(), 0, 0});
}
// In the plane x = 0, looking along +x.
Polygon wall(Interval y, Interval z) {
  return parallelogram({0, y.from, z.from}, {0, y.width(), 0}, {0, 0, z.width()});
}

void parallel() {
  check_factor("coaxial", kFloor, ceiling({0, 1}, {0, 2}, 0.8), coaxial_rectangles(1, 2, 0.8));
  check_factor("coaxial, close", kFloor, ceiling({0, 1}, {0, 2}, 0.05),
               coaxial_rectangles(1, 2, 0.05));
  check_factor("parallel, offset", kFloor, ceiling({1.5, 2}, {-1, 0.5}, 0.8),
               parallel_rectangles({0, 1}, {0, 2}, {1.5, 2}, {-1, 0.5}, 0.8));
}

void perpendicular() {
  check_factor("shared edge", kFloor, wall({0, 2}, {0, 1}), shared_edge_rectangles(2, 1, 1));
  check_factor("shared edge, low wall", kFloor, wall({0, 2}, {0, 0.1}),
               shared_edge_rectangles(2, 1, 0.1));
  check_factor("perpendicular, offset", kFloor, wall({3, 4}, {0.3, 1}),
               perpendicular_rectangles({0, 1}, {0, 2}, {0.3, 1}, {3, 4}));
  check_factor("corner to corner", kFloor, wall({2, 3}, {0, 1}),
               perpendicular_rectangles({0, 1}, {0, 2}, {0, 1}, {2, 3}));
}

void wedges() {
  for (int degrees : {30, 60, 90, 120, 150}) {
    const double angle = degrees * pi / 180;
    const Vector leg = {std::cos(angle), 0, std::sin(angle)};
    const std::string what = "wedge of " + std::to_string(degrees) + " degrees";
    check_factor(what.c_str(), kFloor, parallelogram({0, 0, 0}, {0, 2, 0}, leg),
                 wedge(2, 1, 1, angle));
  }
}

// The emitter faces the floor at height 1; a plate parallel to both hides what it projects onto it.
double half_hidden_factor(Interval x, Interval y, double height) {
  const Interval emitter_x = {0, 1}, emitter_y = {0, 2};
  return mean_over(composite_rule(4, 60), kFloor[0], kFloor[1] - kFloor[0], kFloor[3] - kFloor[0],
                   [&](Vector p) {
                     const auto shadow = [&](Interval plate, double at, Interval whole) {
                       return Interval{std::max(whole.from, at + (plate.from - at) / height),
                                       std::min(whole.to, at + (plate.to - at) / height)};
                     };
                     const Interval sx = shadow(x, p.x, emitter_x), sy = shadow(y, p.y, emitter_y);
                     const Vector up = {0, 0, 1};
                     double seen = point_to_polygon(p, up, ceiling(emitter_x, emitter_y, 1));
                     if (sx.width() > 0 && sy.width() > 0)
                       seen -= point_to_polygon(p, up, ceiling(sx, sy, 1));
                     return seen;
                   });
}

void half_hidden_emitters() {
  const Polygon emitter = ceiling({0, 1}, {0, 2}, 1);
  // The integral itself: a plate on the emitter hides all of it, one beside it nothing.
  CHECK_NEAR(half_hidden_factor({0, 1}, {0, 2}, 1), 0, 1e-12);
  CHECK_NEAR(half_hidden_factor({2, 3}, {0, 2}, 1), coaxial_rectangles(1, 2, 1), 1e-10);
  for (double height : {0.5, 0.2}) {
    const Interval x = height == 0.5 ? Interval{0.25, 0.75} : Interval{0.1, 0.4};
    const Interval y = height == 0.5 ? Interval{0.5, 1.5} : Interval{0.3, 1.9};
    check_factor("half hidden", kFloor, emitter, half_hidden_factor(x, y, height), 0.005,
                 ceiling(x, y, height));
  }
}

// A1 F12 = A2 F21, each solved on its own.
void reciprocity() {
  const Polygon small = wall({0.2, 0.9}, {0, 0.4});
  for (const Polygon& other : {small, ceiling({0.5, 2}, {1, 1.5}, 0.4)}) {
    const double there = area(kFloor) * solved_factor(kFloor, other);
    const double back = area(other) * solved_factor(other, kFloor);
    std::printf("reciprocity: %.7f and %.7f  %+.4f %%\n", there, back, 100 * (back / there - 1));
    CHECK_NEAR(back, there, 0.001 * there);
  }
}

// Receivers that reflect nothing leave nothing by which an error could be weighed; their irradiance
// is right all the same.
void black_receivers() {
  const double solved = solved_factor(kFloor, wall({0, 2}, {0, 1}), {}, 0);
  const double exact = shared_edge_rectangles(2, 1, 1);
  std::printf("black receiver: %.7f exact %.7f  %+.4f %%\n", solved, exact,
              100 * (solved / exact - 1));
  CHECK_NEAR(solved, exact, 0.005 * exact);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(parallel),    HRAD_TEST(perpendicular),
      HRAD_TEST(wedges),      HRAD_TEST(half_hidden_emitters),
      HRAD_TEST(reciprocity), HRAD_TEST(black_receivers),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
