// Colours for display: the sRGB table against the standard's formula, the exposure against its
// definition.
#include <cmath>

#include "base/hash.h"
#include "export_room.h"
#include "solver/display_color.h"

namespace {

using namespace hrad;
using hrad_test::solved;

double encoded(double linear) {
  return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

double decoded(double byte) {
  const double s = byte / 255;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

void every_byte_comes_back() {
  for (int k = 0; k < 256; ++k) CHECK_EQUAL(int{srgb_byte(decoded(k))}, k);
  CHECK_EQUAL(int{srgb_byte(0)}, 0);
  CHECK_EQUAL(int{srgb_byte(1)}, 255);
}

void bytes_are_the_nearest() {
  for (uint64_t i = 0; i < 20000; ++i) {
    double linear = unit_interval(mix(3, i));
    if (i % 2) linear *= linear * linear;  // more of the dark ones
    CHECK_NEAR(srgb_byte(linear), encoded(linear), 0.5 + 1e-4);
  }
  for (int k = 0; k < 255; ++k) {
    const double between = decoded(k + 0.5);
    CHECK_EQUAL(int{srgb_byte(between * (1 - 1e-9))}, k);
    CHECK_EQUAL(int{srgb_byte(between * (1 + 1e-9))}, k + 1);
  }
}

void the_exposure_makes_white_of_what_is_bright() {
  const Solver& solver = solved();
  const DisplayColors colors(solver);
  const double white = 1 / colors.exposure();
  double total = 0, below = 0, up_to = 0;
  for (int64_t i = 0; i < solver.leaf_count(); ++i) {
    double emission[2], radiosity[2];
    solver.leaf_values(i, Quantity::emission, emission);
    solver.leaf_values(i, Quantity::radiosity, radiosity);
    if (emission[0] > 0) continue;
    const double mean = (radiosity[0] + radiosity[1]) / 2, area = solver.leaf(i).area;
    total += area;
    if (mean < white * (1 - 1e-12)) below += area;
    if (mean < white * (1 + 1e-12)) up_to += area;
  }
  CHECK(below < 0.95 * total && up_to >= 0.95 * total);
}

void other_bands_than_three_are_grey() {
  const DisplayColors colors(solved());
  const double radiosity[2] = {0.5 / colors.exposure(), 0.25 / colors.exposure()};
  for (const double value : colors.linear(radiosity)) CHECK_NEAR(value, 0.375, 1e-12);
  const double bright[2] = {1e300, 1e300};
  for (const double value : colors.linear(bright)) CHECK_EQUAL(value, 1.0);
}

// A scene without light has no white to find.
void darkness_is_black() {
  Solver solver;
  const double xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int64_t corners[] = {0, 1, 2};
  solver.add_patches(3, xyz, 1, corners, nullptr);
  CHECK(static_cast<int>(solver.solve()) >= 0);
  const DisplayColors colors(solver);
  CHECK_EQUAL(colors.exposure(), 1.0);
  const double radiosity[3] = {0, 0, 0};
  for (const double value : colors.linear(radiosity)) CHECK_EQUAL(value, 0.0);
}

// Where nothing but emitters is lit, they are what is looked at.
void emitters_alone_are_exposed() {
  Solver solver;
  solver.add_material({"lamp", {0.5, 0.5, 0.5}, {20, 40, 10}, false, false});
  const double xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int64_t corners[] = {0, 1, 2};
  solver.add_patches(3, xyz, 1, corners, nullptr);
  CHECK(static_cast<int>(solver.solve()) >= 0);
  CHECK_NEAR(DisplayColors(solver).exposure(), 1.0 / 40, 1e-9);
}

}  // namespace

int main() {
  const struct CMUnitTest tests[] = {
      HRAD_TEST(every_byte_comes_back),
      HRAD_TEST(bytes_are_the_nearest),
      HRAD_TEST(the_exposure_makes_white_of_what_is_bright),
      HRAD_TEST(other_bands_than_three_are_grey),
      HRAD_TEST(darkness_is_black),
      HRAD_TEST(emitters_alone_are_exposed),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
