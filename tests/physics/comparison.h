// The error of a solution against the Monte Carlo reference, by the definition of `accuracy`: RMS
// of the radiosity over surfaces that don't emit, relative to the RMS of the radiosity, all bands
// together. The noise of the reference is subtracted; what is left of it is the standard error.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "physics/api_solver.h"
#include "physics/monte_carlo.h"

namespace physics {

struct Comparison {
  double rms = 0;             // relative, noise subtracted; 0 when the noise hides it
  double standard_error = 0;  // of rms
  double bias = 0;            // (sum of B - sum of B*) / sum of B*, signed
  double noise = 0;           // RMS of the reference's noise, relative
  int64_t count = 0;
  double sealed = 0;        // points: share of the area that sees nothing, left out
  int64_t disagreeing = 0;  // points that only one of the two holds for sealed

  void print(const char* what) const {
    std::printf("%-44s rms %6.3f %% +- %.3f  bias %+7.3f %%  noise %.3f %%  n %lld", what,
                100 * rms, 100 * standard_error, 100 * bias, 100 * noise,
                static_cast<long long>(count));
    if (sealed > 0)
      std::printf("  sealed %.3f %%, %lld disagree", 100 * sealed,
                  static_cast<long long>(disagreeing));
    std::printf("\n");
    std::fflush(stdout);
  }
};

// Sums of area x error over sides or points.
class ErrorSums {
 public:
  void add(double area, const Spectrum& value, const Spectrum& wanted, const Spectrum& variance) {
    double square = 0;
    for (int k = 0; k < max_bands; ++k) {
      const double d = value[k] - wanted[k];
      square += d * d - variance[k];
      noise_ += area * variance[k];
      energy_ += area * (wanted[k] * wanted[k] - variance[k]);
      difference_ += area * d;
      total_ += area * wanted[k];
      // The variance of d^2 - variance, d being normal with the true error as its mean.
      spread_ += area * area * 2 * variance[k] * std::max(variance[k], 2 * d * d - variance[k]);
    }
    squares_ += area * square;
    ++count_;
  }

  Comparison result() const {
    Comparison c;
    c.rms = std::sqrt(std::max(0.0, squares_) / energy_);
    const double error = std::sqrt(spread_) / energy_;  // of rms^2
    c.standard_error = c.rms > std::sqrt(error) ? error / (2 * c.rms) : std::sqrt(error);
    c.bias = difference_ / total_;
    c.noise = std::sqrt(noise_ / energy_);
    c.count = count_;
    return c;
  }

 private:
  double squares_ = 0, energy_ = 0, noise_ = 0, difference_ = 0, total_ = 0, spread_ = 0;
  int64_t count_ = 0;
};

// The sides of patches that don't emit.
inline std::vector<Side> dark_sides(const std::vector<Surface>& surfaces) {
  std::vector<Side> sides;
  for (size_t i = 0; i < surfaces.size(); ++i)
    for (int side = 0; side < surfaces[i].sides(); ++side)
      if (!surfaces[i].emits()) sides.push_back({static_cast<int64_t>(i), side});
  return sides;
}

// The reference means of a scene's dark sides; made once, compared with several solutions.
struct PatchReference {
  std::vector<Side> sides;
  std::vector<Estimate> irradiance;

  PatchReference(const MonteCarlo& reference, int64_t paths)
      : sides(dark_sides(reference.surfaces())), irradiance(reference.over_sides(sides, paths)) {}

  Comparison compare(const ApiSolver& solver, const MonteCarlo& reference) const {
    const std::vector<Spectrum> radiosity[2] = {solver.patches(HRAD_RADIOSITY, HRAD_FRONT),
                                                solver.patches(HRAD_RADIOSITY, HRAD_BACK)};
    ErrorSums sums;
    for (size_t i = 0; i < sides.size(); ++i) {
      const Surface& s = reference.surfaces()[sides[i].surface];
      const Spectrum& rho = s.reflectance;
      sums.add(s.area, radiosity[sides[i].side][sides[i].surface], rho * irradiance[i].mean,
               rho * rho * irradiance[i].variance);
    }
    return sums.result();
  }
};

// Points drawn by area from the dark sides, with their reference.
struct PointReference {
  std::vector<Side> sides;
  std::vector<double> uv;
  std::vector<Estimate> irradiance;

  PointReference(const MonteCarlo& reference, int64_t count, int replicates, int64_t samples,
                 uint64_t seed) {
    const std::vector<Side> all = dark_sides(reference.surfaces());
    std::vector<double> area_so_far;
    double area = 0;
    for (const Side& s : all) area_so_far.push_back(area += reference.surfaces()[s.surface].area);
    Random random(seed);
    for (int64_t i = 0; i < count; ++i) {
      const double wanted =
          area * (static_cast<double>(i) + random.uniform()) / static_cast<double>(count);
      const auto chosen = std::upper_bound(area_so_far.begin(), area_so_far.end() - 1, wanted);
      sides.push_back(all[static_cast<size_t>(chosen - area_so_far.begin())]);
      const double root = std::sqrt(random.uniform()), other = random.uniform();
      const double u = root * (1 - other), v = root * other;
      uv.insert(uv.end(), {u, v});
      irradiance.push_back(reference.at_point(sides.back(), u, v, replicates, samples));
    }
  }

  Comparison compare(const ApiSolver& solver, const MonteCarlo& reference) const {
    std::vector<int64_t> patch[2];
    std::vector<double> place[2];
    for (size_t i = 0; i < sides.size(); ++i) {
      patch[sides[i].side].push_back(sides[i].surface);
      place[sides[i].side].insert(place[sides[i].side].end(), {uv[2 * i], uv[2 * i + 1]});
    }
    std::vector<Spectrum> radiosity[2];
    for (int side = 0; side < 2; ++side)
      radiosity[side] = solver.points(HRAD_RADIOSITY, side, patch[side], place[side]);
    ErrorSums sums;
    size_t next[2] = {0, 0};
    int64_t sealed = 0, disagreeing = 0;
    for (size_t i = 0; i < sides.size(); ++i) {
      const Spectrum& b = radiosity[sides[i].side][next[sides[i].side]++];
      const Spectrum& rho = reference.surfaces()[sides[i].surface].reflectance;
      // Sealed: no ray meets a front. (Deep gaps see fronts and yet hardly any light.)
      const bool dark = irradiance[i].black + irradiance[i].escaped == 1;
      if (largest(rho) > 0)
        disagreeing += dark ? sum(b) > 0 : sum(b) == 0 && sum(irradiance[i].mean) > 0;
      sealed += dark;
      if (!dark) sums.add(1, b, rho * irradiance[i].mean, rho * rho * irradiance[i].variance);
    }
    Comparison c = sums.result();
    c.sealed = static_cast<double>(sealed) / static_cast<double>(sides.size());
    c.disagreeing = disagreeing;
    return c;
  }
};

}  // namespace physics
