// Lambert's formula from a point to a triangle: closed forms, numeric integration, enclosures.
#include <cmath>
#include <vector>

#include "base/angle.h"
#include "links/form_factor.h"
#include "support/check.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using hrad_test::Random;

// The kernel integrated by the midpoint rule over n*n equal parts of the triangle.
double integrated(Vec3 x, Vec3 normal, const Triangle& t, int n) {
  const Vec3 vector = t.area_vector();
  const Vec3 facing = normalized(vector);
  double sum = 0;
  const auto add = [&](double u, double v) {
    const Vec3 d = t.at(u / n, v / n) - x;
    const double at_x = dot(d, normal), at_t = -dot(d, facing), d2 = dot(d, d);
    if (at_x > 0 && at_t > 0) sum += at_x * at_t / (pi * d2 * d2);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      add(i + 1.0 / 3, j + 1.0 / 3);
      if (i + j + 1 < n) add(i + 2.0 / 3, j + 2.0 / 3);
    }
  return sum * length(vector) / 2 / n / n;
}

// A rectangle a x b at height c, one corner straight above x, the normals facing.
double rectangle_above(double a, double b, double c) {
  const double x = a / c, y = b / c;
  const double rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
  return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2 * pi);
}

double of_rectangle(Vec3 x, Vec3 normal, Vec3 corner, Vec3 p, Vec3 q) {
  return point_to_triangle(x, normal, {corner, corner + p, corner + p + q}) +
         point_to_triangle(x, normal, {corner, corner + p + q, corner + q});
}

void rectangles_above_have_their_closed_form() {
  for (double a : {0.001, 0.3, 1.0, 7.0, 1e4})
    for (double b : {0.02, 1.0, 40.0})
      for (double c : {0.01, 1.0, 30.0}) {
        // Seen from below: the front looks down.
        const double found = of_rectangle({0, 0, 0}, {0, 0, 1}, {0, 0, c}, {0, b, 0}, {a, 0, 0});
        CHECK_NEAR(found, rectangle_above(a, b, c), 1e-11);
      }
}

void a_standing_half_plane_has_its_closed_form() {
  // A wall of great width and height h at distance d takes (1 - d / sqrt(d^2 + h^2)) / 2 of the
  // sky.
  for (double h : {0.1, 1.0, 20.0}) {
    const double found = of_rectangle({0, 0, 0}, {0, 0, 1}, {1, -1e7, 0}, {0, 0, h}, {0, 2e7, 0});
    CHECK_NEAR(found, (1 - 1 / std::sqrt(1 + h * h)) / 2, 1e-9);
  }
}

void any_triangle_agrees_with_integration() {
  Random random(11);
  int lit = 0, cut = 0;
  for (int k = 0; k < 150; ++k) {
    const Vec3 x = random.in_cube(1), normal = normalized(random.in_cube(1));
    const Triangle t{random.in_cube(2), random.in_cube(2), random.in_cube(2)};
    const Vec3 facing = normalized(t.area_vector());
    // Close to the plane of the source the midpoint rule is too coarse.
    if (std::fabs(dot(facing, t.a - x)) < 0.3) continue;
    const double wanted = integrated(x, normal, t, 150);
    CHECK_NEAR(point_to_triangle(x, normal, t), wanted, 2e-4);
    int above = 0;
    for (const Vec3& p : {t.a, t.b, t.c}) above += dot(p - x, normal) > 0;
    lit += wanted > 0;
    cut += wanted > 0 && above < 3;
  }
  CHECK(lit > 20);
  CHECK(cut > 10);
}

void small_sources_follow_the_inverse_square() {
  const Vec3 normal{0, 0, 1};
  for (double size : {1e-2, 1e-3, 2e-4}) {
    const Vec3 corner{0.5, -0.2, 0.9};
    const Triangle t{corner, corner + Vec3{0, size, 0}, corner + Vec3{size, 0, 0}};
    const Vec3 d = t.centroid();
    const double d2 = dot(d, d);
    const double wanted = size * size / 2 * d.z * d.z / (pi * d2 * d2);
    CHECK_NEAR(point_to_triangle({0, 0, 0}, normal, t), wanted, 1e-9 + wanted * size);
  }
}

void closed_rooms_add_up_to_one() {
  Random random(12);
  for (int shape = 0; shape < 40; ++shape) {
    Scene room;
    Vec3 low{0, 0, 0}, high{1, 1, 1};
    if (shape % 2)
      high = {random.between(0.1, 10), random.between(0.1, 10), random.between(0.1, 5)};
    hrad_test::add_box(room, low, high, true);
    const Vec3 e = high - low;
    const Vec3 x{e.x * random.between(0.01, 0.99), e.y * random.between(0.01, 0.99),
                 e.z * random.between(0.01, 0.99)};
    const Vec3 normal = normalized(random.in_cube(1));
    double sum = 0;
    for (int64_t p = 0; p < room.patch_count(); ++p)
      sum += point_to_triangle(x, normal, room.triangle(p));
    CHECK_NEAR(sum, 1, 1e-10);
  }
}

// From a point of a wall, too: nothing lies behind its horizon, the wall itself counts for nothing.
void walls_see_the_rest_of_the_room() {
  Scene room;
  hrad_test::add_box(room, {0, 0, 0}, {3, 2, 1}, true);
  Random random(13);
  for (int64_t p = 0; p < room.patch_count(); ++p) {
    const Triangle wall = room.triangle(p);
    const Vec3 x = hrad_test::point_on(wall, random), normal = normalized(wall.area_vector());
    double sum = 0;
    for (int64_t q = 0; q < room.patch_count(); ++q)
      sum += point_to_triangle(x, normal, room.triangle(q));
    CHECK_NEAR(sum, 1, 1e-10);
    CHECK_NEAR(point_to_triangle(x, normal, wall), 0, 1e-10);
  }
}

void cutting_the_source_changes_nothing() {
  Random random(14);
  for (int k = 0; k < 500; ++k) {
    const Vec3 x = random.in_cube(1), normal = normalized(random.in_cube(1));
    const Triangle t{random.in_cube(2), random.in_cube(2), random.in_cube(2)};
    const Vec3 ab = (t.a + t.b) * 0.5, bc = (t.b + t.c) * 0.5, ca = (t.c + t.a) * 0.5;
    const double parts =
        point_to_triangle(x, normal, {t.a, ab, ca}) + point_to_triangle(x, normal, {ab, t.b, bc}) +
        point_to_triangle(x, normal, {ca, bc, t.c}) + point_to_triangle(x, normal, {bc, ca, ab});
    CHECK_NEAR(point_to_triangle(x, normal, t), parts, 1e-10);
    // Nor does it matter at which corner one begins.
    CHECK_NEAR(point_to_triangle(x, normal, {t.b, t.c, t.a}), point_to_triangle(x, normal, t),
               1e-12);
  }
}

void what_is_turned_away_counts_nothing() {
  const Triangle up{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Triangle down{up.a, up.c, up.b};
  const Vec3 above{0.2, 0.2, 1}, below{0.2, 0.2, -1};
  CHECK(point_to_triangle(above, {0, 0, -1}, up) > 0.05);
  CHECK_EQUAL(point_to_triangle(above, {0, 0, -1}, down), 0.0);  // its back
  CHECK_EQUAL(point_to_triangle(below, {0, 0, 1}, up), 0.0);     // its back
  CHECK(point_to_triangle(below, {0, 0, 1}, down) > 0.05);
  CHECK_EQUAL(point_to_triangle(above, {0, 0, 1}, up), 0.0);      // behind the horizon
  CHECK_EQUAL(point_to_triangle({3, 3, 0}, {0, 0, 1}, up), 0.0);  // in its plane
  CHECK_EQUAL(point_to_triangle({3, 3, 0}, {-1, 0, 0}, up), 0.0);
}

void values_stay_between_nothing_and_all() {
  Random random(15);
  for (int k = 0; k < 20000; ++k) {
    // Hard against the source, and among corners that nearly coincide.
    const double reach = k % 2 ? 1e-9 : 1;
    const Triangle t{random.in_cube(1), random.in_cube(1), random.in_cube(1)};
    const Vec3 x = hrad_test::point_on(t, random) + random.in_cube(reach);
    const double factor = point_to_triangle(x, normalized(random.in_cube(1)), t);
    CHECK(factor >= 0 && factor <= 1);
  }
  const Triangle wide{{-1e3, -1e3, 0}, {1e3, -1e3, 0}, {0, 1e3, 0}};
  CHECK_NEAR(point_to_triangle({0, 0, 1e-3}, {0, 0, -1}, wide), 1, 1e-9);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(rectangles_above_have_their_closed_form),
      HRAD_TEST(a_standing_half_plane_has_its_closed_form),
      HRAD_TEST(any_triangle_agrees_with_integration),
      HRAD_TEST(small_sources_follow_the_inverse_square),
      HRAD_TEST(closed_rooms_add_up_to_one),
      HRAD_TEST(walls_see_the_rest_of_the_room),
      HRAD_TEST(cutting_the_source_changes_nothing),
      HRAD_TEST(what_is_turned_away_counts_nothing),
      HRAD_TEST(values_stay_between_nothing_and_all),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
