// The exposure, and the sRGB curve as a table made at compile time. Floor 8 (solver).
#include "solver/display_color.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "solver/solver.h"

namespace hrad {
namespace {

constexpr double exposed_share = 0.95;  // of the lit area, that stays below white
// A white below this is none: its reciprocal would overflow.
constexpr double darkest_white = 1e-300;

// x^(1/5) for 0 < x <= 1 by Newton's method, from above, where it converges without oscillation.
constexpr double fifth_root(double x) {
  double root = 1;
  for (int step = 0; step < 100; ++step) root = (4 * root + x / (root * root * root * root)) / 5;
  return root;
}

// The linear value of an sRGB value, both in 0..1: ((s + 0.055) / 1.055)^2.4 over the straight
// piece.
constexpr double decoded(double srgb) {
  if (srgb <= 0.04045) return srgb / 12.92;
  const double base = (srgb + 0.055) / 1.055;
  return base * base * fifth_root(base * base);
}

struct Thresholds {
  double from[255];  // from[k]: the linear value from which k + 1 is nearer than k
};

constexpr Thresholds make_thresholds() {
  Thresholds thresholds{};
  for (int k = 0; k < 255; ++k) thresholds.from[k] = decoded((k + 0.5) / 255);
  return thresholds;
}

constexpr Thresholds thresholds = make_thresholds();

std::array<double, 3> red_green_blue(const double* radiosity, int bands) {
  if (bands == 3) return {radiosity[0], radiosity[1], radiosity[2]};
  double mean = 0;
  for (int band = 0; band < bands; ++band) mean += radiosity[band] / bands;
  return {mean, mean, mean};
}

double brightest(const std::array<double, 3>& rgb) { return std::max({rgb[0], rgb[1], rgb[2]}); }

// The value that the share of the area stays below; 0 without area.
double white_of(std::vector<std::pair<double, double>>& values_and_areas) {
  std::sort(values_and_areas.begin(), values_and_areas.end());
  double total = 0, below = 0;
  for (const auto& entry : values_and_areas) total += entry.second;
  for (const auto& [value, area] : values_and_areas) {
    below += area;
    if (below >= exposed_share * total) return value;
  }
  return 0;
}

}  // namespace

DisplayColors::DisplayColors(const Solver& solver) : bands_(solver.scene().bands) {
  std::vector<double> radiosity(static_cast<size_t>(bands_));
  std::vector<std::pair<double, double>> reflecting, emitting;
  for (int64_t i = 0; i < solver.leaf_count(); ++i) {
    solver.leaf_values(i, Quantity::radiosity, radiosity.data());
    const double value = brightest(red_green_blue(radiosity.data(), bands_));
    if (value <= 0) continue;
    const LeafView leaf = solver.leaf(i);
    (solver.scene().emits(leaf.patch) ? emitting : reflecting).emplace_back(value, leaf.area);
  }
  const double white = white_of(reflecting.empty() ? emitting : reflecting);
  if (white > darkest_white) exposure_ = 1 / white;
}

std::array<double, 3> DisplayColors::linear(const double* radiosity) const {
  std::array<double, 3> rgb = red_green_blue(radiosity, bands_);
  for (double& value : rgb) value = std::min(1.0, exposure_ * value);
  return rgb;
}

uint8_t srgb_byte(double linear) {
  const double* end = thresholds.from + 255;
  return static_cast<uint8_t>(std::upper_bound(thresholds.from, end, linear) - thresholds.from);
}

}  // namespace hrad
