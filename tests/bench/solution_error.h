// The error of a solution against the reference: RMS of the radiosity over dark surfaces relative
// to the RMS of the radiosity itself, all bands together (the definition of `accuracy`), the
// reference's noise subtracted; and bias.
#pragma once

#include "bench/reference.h"
#include "physics/api_solver.h"

namespace bench {

struct SolutionError {
  double rms = 0, rms_error = 0;    // relative; 0 when the noise hides it; its standard error
  double bias = 0, bias_error = 0;  // (sum of B - sum of B*) / sum of B*
  double noise = 0;                 // RMS of the reference's noise, relative
  double sealed = 0;                // points: share of the area inside contacts, left out
  int64_t count = 0;
  int64_t disagreeing = 0;  // points that only one of the two holds for sealed
};

// The solution's radiosity of each target.
inline std::vector<Spectrum> radiosity_of(const physics::ApiSolver& solver, const TargetSet& set) {
  std::vector<Spectrum> result(set.targets.size());
  for (int64_t side = 0; side < 2; ++side) {
    std::vector<int64_t> patch;
    std::vector<double> uv;
    std::vector<size_t> which;
    for (size_t i = 0; i < set.targets.size(); ++i) {
      const Target& t = set.targets[i];
      if (t.side != side) continue;
      which.push_back(i);
      patch.push_back(t.surface);
      if (t.is_point()) uv.insert(uv.end(), {t.u, t.v});
    }
    if (which.empty()) continue;
    const int32_t side_number = static_cast<int32_t>(side);
    const std::vector<Spectrum> values =
        uv.empty() ? solver.patches(HRAD_RADIOSITY, side_number)
                   : solver.points(HRAD_RADIOSITY, side_number, patch, uv);
    for (size_t i = 0; i < which.size(); ++i)
      result[which[i]] = values[uv.empty() ? static_cast<size_t>(patch[i]) : i];
  }
  return result;
}

// RMS of a reference's own noise, relative as above: the error of path tracing for so long.
inline double noise_of(const TargetSet& set, const PathTracer& tracer) {
  double noise = 0, energy = 0;
  for (const Target& t : set.targets) {
    const Spectrum rho = tracer.surfaces()[t.surface].reflectance;
    const Spectrum wanted = rho * t.mean(), variance = rho * rho * t.variance();
    noise += t.weight * physics::sum(variance);
    energy += t.weight * (physics::sum(wanted * wanted) - physics::sum(variance));
  }
  return energy > 0 ? std::sqrt(noise / energy) : 0;
}

inline SolutionError error_of(const std::vector<Spectrum>& solution, const TargetSet& set,
                              const PathTracer& tracer) {
  const std::vector<Surface>& surfaces = tracer.surfaces();
  struct Terms {  // of one target, weighted: error, energy and noise squared, and their spread
    double square = 0, energy = 0, noise = 0, spread = 0;
    double difference = 0, total = 0, difference_spread = 0;
  };
  std::vector<Terms> terms;
  Terms all;
  SolutionError e;
  double sealed = 0, area = 0;
  for (size_t i = 0; i < set.targets.size(); ++i) {
    const Target& t = set.targets[i];
    area += t.weight;
    if (t.is_point()) {
      const bool lit = physics::sum(solution[i]) > 0;
      const Surface& s = surfaces[t.surface];
      const bool sealed_here =
          t.is_dark() &&
          (tracer.covers().covered(static_cast<size_t>(t.surface), t.side, s.at(t.u, t.v)) ||
           tracer.sealed(s.at(t.u, t.v), t.side == 0 ? s.normal : s.normal * -1));
      e.disagreeing += physics::sum(s.reflectance) > 0 && sealed_here == lit;
      if (sealed_here) {
        sealed += t.weight;
        continue;
      }
    }
    const Spectrum rho = surfaces[t.surface].reflectance;
    const Spectrum wanted = rho * t.mean(), variance = rho * rho * t.variance();
    Terms x;
    for (int k = 0; k < physics::max_bands; ++k) {
      const double d = solution[i][k] - wanted[k], v = variance[k];
      x.square += t.weight * (d * d - v);
      x.energy += t.weight * (wanted[k] * wanted[k] - v);
      x.noise += t.weight * v;
      // The variance of d^2 - v, d being normal with the true error as its mean.
      x.spread += t.weight * t.weight * 2 * v * std::max(v, 2 * d * d - v);
      x.difference += t.weight * d;
      x.total += t.weight * wanted[k];
      x.difference_spread += t.weight * t.weight * v;
    }
    all.square += x.square, all.energy += x.energy, all.noise += x.noise, all.spread += x.spread;
    all.difference += x.difference, all.total += x.total;
    all.difference_spread += x.difference_spread;
    terms.push_back(x);
  }
  if (terms.empty() || all.energy <= 0) return e;
  const double ratio = std::max(0.0, all.square / all.energy), bias = all.difference / all.total;
  if (set.is_sample) {
    // Which targets were drawn matters as well as the noise: the spread of the ratio's terms tells
    // both.
    all.spread = all.difference_spread = 0;
    for (const Terms& x : terms) {
      const double r = x.square - ratio * x.energy, b = x.difference - bias * x.total;
      all.spread += r * r;
      all.difference_spread += b * b;
    }
  }
  const double error = std::sqrt(all.spread) / all.energy;  // of rms^2
  e.rms = std::sqrt(ratio);
  e.rms_error = e.rms > std::sqrt(error) ? error / (2 * e.rms) : std::sqrt(error);
  e.bias = bias;
  e.bias_error = std::sqrt(all.difference_spread) / all.total;
  e.noise = std::sqrt(all.noise / all.energy);
  e.sealed = area > 0 ? sealed / area : 0;
  e.count = static_cast<int64_t>(terms.size());
  return e;
}

}  // namespace bench
