// Enclosures that are solved in a line: spheres, where every point sees every part of the inside by
// its share of the area; plates close together; sheets, blockers and bands in a furnace.
#include <memory>

#include "physics/api_solver.h"
#include "physics/solids.h"
#include "support/check.h"

using namespace physics;

namespace {

double total_area(const std::vector<Polygon>& faces) {
  double sum = 0;
  for (const Polygon& f : faces) sum += area(f);
  return sum;
}

void print(const char* what, double solved, double exact) {
  std::printf("%-40s %.6f exact %.6f  %+.4f %%\n", what, solved, exact, 100 * (solved / exact - 1));
  std::fflush(stdout);
}

// Half of a hollow sphere emits. F_ij = A_j / A for all, so that H is the same everywhere.
void a_hollow_sphere() {
  const double rho1 = 0.7, rho2 = 0.4, e = 2;
  ApiSolver solver(1);
  const int32_t lit = solver.add_material(gray(rho1), gray(e));
  const int32_t dark = solver.add_material(gray(rho2), gray(0));
  std::vector<Polygon> upper, lower;
  for (const Polygon& f : sphere_faces({0, 0, 0}, 1, 3, true))
    ((f[0] + f[1] + f[2]).z > 0 ? upper : lower).push_back(f);
  solver.add(upper, lit);
  const int64_t first = solver.add(lower, dark);
  solver.solve();
  const double a1 = total_area(upper), a2 = total_area(lower), share = a1 / (a1 + a2);
  const double h = e * share / (1 - rho1 * share - rho2 * (1 - share));
  const double solved = solver.mean(HRAD_IRRADIANCE, first, solver.size() - first)[0];
  print("hollow sphere, dark half: H", solved, h);
  CHECK_NEAR(solved, h, 0.005 * h);
  CHECK_NEAR(solver.mean(HRAD_RADIOSITY, 0, first)[0], e + rho1 * h, 0.005 * (e + rho1 * h));
}

// A sphere in a hollow sphere: H1 = B2, H2 = (A1/A2) B1 + (1 - A1/A2) B2.
void concentric_spheres() {
  const double rho1 = 0.6, rho2 = 0.8, e1 = 3;
  ApiSolver solver(1);
  const std::vector<Polygon> inner = sphere_faces({0, 0, 0}, 0.5, 3, false);
  const std::vector<Polygon> outer = sphere_faces({0, 0, 0}, 1, 3, true);
  solver.add(inner, solver.add_material(gray(rho1), gray(e1)));
  const int64_t first = solver.add(outer, solver.add_material(gray(rho2), gray(0)));
  solver.solve();
  const double f21 = total_area(inner) / total_area(outer);
  // B1 = e1 + rho1 B2; B2 = rho2 (f21 B1 + (1 - f21) B2).
  const double b2 = rho2 * f21 * e1 / (1 - rho2 * (1 - f21) - rho2 * f21 * rho1);
  const double solved = solver.mean(HRAD_RADIOSITY, first, solver.size() - first)[0];
  print("concentric spheres, outer: B", solved, b2);
  CHECK_NEAR(solved, b2, 0.01 * b2);
  const double b1 = e1 + rho1 * b2, solved1 = solver.mean(HRAD_RADIOSITY, 0, first)[0];
  print("concentric spheres, inner: B", solved1, b1);
  CHECK_NEAR(solved1, b1, 0.005 * b1);
}

// The inner sphere blocks and absorbs: H = (1 - A1/A2) B everywhere outside it.
void a_blocker_in_a_sphere() {
  const double rho = 0.8, e = 1;
  ApiSolver solver(1);
  const std::vector<Polygon> inner = sphere_faces({0, 0, 0}, 0.5, 3, false);
  const std::vector<Polygon> outer = sphere_faces({0, 0, 0}, 1, 3, true);
  const int64_t first = solver.add(outer, solver.add_material(gray(rho), gray(e)));
  const int64_t blocker = solver.add(inner, solver.add_material(gray(0), gray(0), HRAD_BLOCKER));
  solver.solve();
  const double f21 = total_area(inner) / total_area(outer);
  const double b = e / (1 - rho * (1 - f21));
  const double solved = solver.mean(HRAD_RADIOSITY, first, blocker)[0];
  print("blocker in a sphere: B", solved, b);
  CHECK_NEAR(solved, b, 0.005 * b);
  const Balance balance = solver.balance();
  print("blocker in a sphere: absorbed by it", balance.absorbed_back, b * total_area(inner));
  CHECK_NEAR(balance.absorbed_back, b * total_area(inner), 0.01 * b * total_area(inner));
  CHECK_EQUAL(solver.mean(HRAD_RADIOSITY, blocker, 4)[0], 0.0);
}

// Two plates 1000 times as wide as their distance: B2 = rho2 E1 / (1 - rho1 rho2).
void plates_close_together() {
  const double rho1 = 0.5, rho2 = 0.6, gap = 1e-3;
  ApiSolver solver(1);
  solver.set("accuracy", 0.005);
  solver.add(parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
             solver.add_material(gray(rho1), gray(1)));
  const int64_t first = solver.add(parallelogram({0, 0, gap}, {0, 1, 0}, {1, 0, 0}),
                                   solver.add_material(gray(rho2), gray(0)));
  solver.solve();
  const double b2 = rho2 / (1 - rho1 * rho2);
  const double solved = solver.mean(HRAD_RADIOSITY, first, 2)[0];
  print("plates close together: B", solved, b2);
  // Along the rim some light escapes: about 2 gap per reflection of the width.
  CHECK_NEAR(solved, b2, 0.01 * b2);
}

// A two-sided sheet from wall to wall: a furnace above, below it is dark. No light leaks.
void a_sheet_that_divides_a_room() {
  const double rho = 0.5;
  ApiSolver solver(1);
  const int32_t dark = solver.add_material(gray(rho), gray(0));
  const int32_t lit = solver.add_material(gray(rho), gray(1));
  // Lower and upper half as rooms without the lid that the sheet is.
  const std::vector<Polygon> below = box_faces({0, 0, 0}, {1, 1, 1}, true);
  const std::vector<Polygon> above = box_faces({0, 0, 1}, {1, 1, 2}, true);
  for (int face : {0, 1, 2, 3, 4}) solver.add(below[face], dark);
  const int64_t upper = solver.size();
  for (int face : {0, 1, 2, 3, 5}) solver.add(above[face], lit);
  const int64_t sheet = solver.add(parallelogram({0, 0, 1}, {1, 0, 0}, {0, 1, 0}),
                                   solver.add_material(gray(rho), gray(0), HRAD_TWO_SIDED));
  solver.solve();
  for (const Spectrum& s :
       {solver.mean(HRAD_RADIOSITY, 0, upper), solver.mean(HRAD_RADIOSITY, sheet, 2, HRAD_BACK)})
    CHECK_NEAR(s[0], 0, 1e-6);
  // The sheet reflects what the five lit faces send: by symmetry of power, emitted = absorbed.
  const double front = solver.mean(HRAD_IRRADIANCE, sheet, 2, HRAD_FRONT)[0];
  const double walls = solver.mean(HRAD_IRRADIANCE, upper, sheet - upper)[0];
  print("divided room: absorbed", (1 - rho) * (front + 5 * walls), 5);
  CHECK_NEAR((1 - rho) * (front + 5 * walls), 5, 0.005 * 5);
  CHECK(front > 1.0 && front < 2.0);
}

// A sheet that hangs free in a furnace, two-sided or made of two windings, changes nothing.
void a_sheet_in_a_furnace() {
  for (bool two_windings : {false, true}) {
    ApiSolver solver(1);
    solver.set("accuracy", 0.01);
    const int32_t wall = solver.add_material(gray(0.5), gray(1));
    solver.add(box_faces({0, 0, 0}, {1, 1, 1}, true), wall);
    const int32_t both = solver.add_material(gray(0.5), gray(1), HRAD_TWO_SIDED);
    const Polygon front = {{0.3, 0.3, 0.3}, {0.8, 0.3, 0.4}, {0.4, 0.7, 0.8}};
    const Polygon behind = {front[0], front[2], front[1]};
    const int64_t sheet = solver.add(front, two_windings ? wall : both);
    if (two_windings) solver.add(behind, wall);
    solver.solve();
    for (int64_t i = 0; i < solver.size(); ++i)
      CHECK_NEAR(solver.mean(HRAD_RADIOSITY, i, 1)[0], 2, 0.02);
    const double other = two_windings ? 0 : 2;  // the back of a one-sided patch answers 0
    CHECK_NEAR(solver.mean(HRAD_RADIOSITY, sheet, 1, HRAD_BACK)[0], other, 0.02);
  }
}

// Solved together, bands give what each gives alone.
void bands_are_independent() {
  const double rho[] = {0.8, 0.3, 0.5, 0}, emitted[] = {1, 5, 0, 2};
  const auto room = [&](const std::vector<int>& bands) {
    auto solver = std::make_unique<ApiSolver>(static_cast<int>(bands.size()));
    Spectrum reflectance, emission;
    for (size_t k = 0; k < bands.size(); ++k) {
      reflectance[static_cast<int>(k)] = rho[bands[k]];
      emission[static_cast<int>(k)] = emitted[bands[k]];
    }
    const int32_t dark = solver->add_material(reflectance, gray(0));
    const int32_t lit = solver->add_material(reflectance, emission);
    const std::vector<Polygon> faces = box_faces({0, 0, 0}, {2, 3, 1.5}, true);
    for (int face = 0; face < 6; ++face) solver->add(faces[face], face == 5 ? lit : dark);
    solver->solve();
    return solver;
  };
  const auto together = room({0, 1, 2, 3});
  for (int band = 0; band < 4; ++band) {
    const auto alone = room({band});
    for (int64_t i = 0; i < alone->size(); ++i) {
      const double solved = together->mean(HRAD_IRRADIANCE, i, 1)[band];
      const double wanted = alone->mean(HRAD_IRRADIANCE, i, 1)[0];
      CHECK_NEAR(solved, wanted, 0.03 * wanted);
      if (band == 2) CHECK_EQUAL(solved, 0.0);
      if (band == 3) {
        const double e = i >= 10 ? emitted[3] : 0;
        CHECK_NEAR(together->mean(HRAD_RADIOSITY, i, 1)[3], e, 1e-12);
      }
    }
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(a_hollow_sphere),
      HRAD_TEST(concentric_spheres),
      HRAD_TEST(a_blocker_in_a_sphere),
      HRAD_TEST(plates_close_together),
      HRAD_TEST(a_sheet_that_divides_a_room),
      HRAD_TEST(a_sheet_in_a_furnace),
      HRAD_TEST(bands_are_independent),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
