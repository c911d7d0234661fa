// An independent estimate of the radiosity solution by path tracing: irradiance at points and means
// over surfaces, with standard errors. Direct light combines sampling of the emitters and of the
// cosine with the balance heuristic (Veach and Guibas 1995), so that no term exceeds the emission.
// Samples come in shifted replicates of an additive recurrence; the spread of the replicates gives
// the error. The same seed gives the same numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "physics/ray_tree.h"

namespace physics {

struct Estimate {
  Spectrum mean;
  Spectrum variance;   // of the mean
  double black = 0;    // share of first rays that met a black back or a blocker
  double escaped = 0;  // share of first rays that met nothing
};

// One side of one surface, as a receiver.
struct Side {
  int64_t surface = 0;
  int side = 0;  // 0 front, 1 back
};

class MonteCarlo {
 public:
  MonteCarlo(std::vector<Surface> surfaces, uint64_t seed)
      : tree_(std::move(surfaces)), seed_(seed) {
    double power = 0;
    for (size_t i = 0; i < this->surfaces().size(); ++i) {
      const Surface& s = this->surfaces()[i];
      if (!s.emits()) continue;
      power += s.area * s.sides() * sum(s.emission);
      emitters_.push_back({static_cast<int64_t>(i), power});
    }
  }

  const std::vector<Surface>& surfaces() const { return tree_.surfaces(); }
  const RayTree& tree() const { return tree_; }

  // Irradiance at a point of a side, from replicates x samples paths.
  Estimate at_point(Side side, double u, double v, int replicates, int64_t samples) const {
    const uint64_t key = Random::mixed(Random::mixed(bits(u)) ^ bits(v));
    return replicated(side, key, replicates, samples,
                      [&](double, double) { return surfaces()[side.surface].at(u, v); });
  }

  // Mean irradiance over a side.
  Estimate over_side(Side side, int replicates, int64_t samples, uint64_t round = 0) const {
    const Surface& s = surfaces()[side.surface];
    return replicated(side, round, replicates, samples, [&](double a, double b) {
      const double root = std::sqrt(a);
      return s.at(root * (1 - b), root * b);
    });
  }

  // Mean irradiance over many sides from about `paths` paths, allotted so that the area-weighted
  // variance of the reflected light is least: n ~ sqrt(area) x deviation, the latter from a pilot.
  std::vector<Estimate> over_sides(const std::vector<Side>& sides, int64_t paths) const {
    constexpr int replicates = 32;
    std::vector<double> share(sides.size());
    double all = 0, all_areas = 0;
    for (size_t i = 0; i < sides.size(); ++i) {
      const Surface& s = surfaces()[sides[i].surface];
      const Estimate pilot = over_side(sides[i], 16, 1, 1);
      share[i] = std::sqrt(s.area * sum(pilot.variance * s.reflectance * s.reflectance));
      all += share[i];
      all_areas += std::sqrt(s.area);
    }
    std::vector<Estimate> estimates(sides.size());
    for (size_t i = 0; i < sides.size(); ++i) {
      const double by_area = std::sqrt(surfaces()[sides[i].surface].area) / all_areas;
      const double part = 0.2 * by_area + 0.8 * (all > 0 ? share[i] / all : by_area);
      const double samples = static_cast<double>(paths) * part / replicates;
      estimates[i] = over_side(sides[i], replicates, std::max<int64_t>(2, std::llround(samples)));
    }
    return estimates;
  }

 private:
  struct Emitter {
    int64_t surface = 0;
    double power_so_far = 0;  // of the emitters up to and including this one
  };
  enum class Met { front, black, nothing };
  // The numbers of the first steps of a path; later ones come from a Random.
  struct FirstSteps {
    double direction[2], emitter[2];
  };

  static uint64_t bits(double v) { return static_cast<uint64_t>(static_cast<int64_t>(v * 0x1p52)); }

  template <typename PointAt>
  Estimate replicated(Side side, uint64_t key, int replicates, int64_t samples,
                      PointAt point_at) const {
    const Surface& s = surfaces()[side.surface];
    const Vector n = side.side == 0 ? s.normal : s.normal * -1;
    const uint64_t name = Random::mixed(static_cast<uint64_t>(2 * side.surface + side.side));
    Random random(seed_ ^ Random::mixed(key + name));
    Spectrum total, squares;
    int64_t black = 0, escaped = 0;
    for (int r = 0; r < replicates; ++r) {
      std::array<double, 6> x;  // shift of the replicate, then the running point
      for (double& value : x) value = random.uniform();
      Spectrum batch;
      for (int64_t i = 0; i < samples; ++i) {
        const Vector p = point_at(x[4], x[5]);
        Met met;
        batch = batch + path(p, n, {{x[0], x[1]}, {x[2], x[3]}}, random, met);
        black += met == Met::black;
        escaped += met == Met::nothing;
        for (int k = 0; k < 6; ++k) {  // the powers of the root of g^7 = g + 1
          constexpr double steps[] = {0.8986537126286992, 0.8075784952213447, 0.7257334129697597,
                                      0.6521830259439715, 0.5860866975779693, 0.5266889867007359};
          x[k] += steps[k];
          x[k] -= std::floor(x[k]);
        }
      }
      batch = batch * (1.0 / static_cast<double>(samples));
      total = total + batch;
      squares = squares + batch * batch;
    }
    Estimate e;
    e.mean = total * (1.0 / replicates);
    for (int b = 0; b < max_bands; ++b) {
      const double spread = squares[b] / replicates - e.mean[b] * e.mean[b];
      e.variance[b] = std::max(0.0, spread) / (replicates - 1);
    }
    const double count = static_cast<double>(replicates * samples);
    e.black = static_cast<double>(black) / count;
    e.escaped = static_cast<double>(escaped) / count;
    return e;
  }

  // One path that starts with a cosine-distributed ray: an unbiased estimate of the irradiance.
  Spectrum path(Vector at, Vector n, FirstSteps first, Random& random, Met& met) const {
    Spectrum light, throughput = gray(1);
    met = Met::nothing;
    for (int bounce = 0;; ++bounce) {
      if (bounce > 0) {
        first = {{random.uniform(), random.uniform()}, {random.uniform(), random.uniform()}};
      }
      const Vector start = at + n * tree_.offset();
      light = light + throughput * from_emitters(at, start, n, first.emitter);
      const Vector direction = cosine_direction(n, first.direction);
      const Hit hit = tree_.nearest(start, direction);
      if (hit.surface < 0) break;
      if (bounce == 0) met = hit.black ? Met::black : Met::front;
      if (hit.black) break;
      const Surface& s = surfaces()[hit.surface];
      at = start + direction * hit.t;
      const Vector facing = hit.back ? s.normal * -1 : s.normal;
      if (s.emits()) {
        const double by_cosine = dot(n, direction) * -dot(facing, direction) / (pi * hit.t * hit.t);
        light = light + throughput * s.emission * (by_cosine / (by_cosine + density(s)));
      }
      n = facing;
      // Absorption ends the path; what survives carries the ratio of the bands on.
      const double survival = largest(s.reflectance);
      if (random.uniform() >= survival) break;
      throughput = throughput * s.reflectance * (1 / survival);
    }
    return light;
  }

  // Probability per area with which a point of an emitter is chosen.
  double density(const Surface& s) const {
    return sum(s.emission) * s.sides() / emitters_.back().power_so_far;
  }

  Spectrum from_emitters(Vector at, Vector start, Vector n, const double* u) const {
    if (emitters_.empty()) return {};
    const double wanted = u[0] * emitters_.back().power_so_far;
    const auto chosen =
        std::upper_bound(emitters_.begin(), emitters_.end() - 1, wanted,
                         [](double w, const Emitter& e) { return w < e.power_so_far; });
    const double before = chosen == emitters_.begin() ? 0 : (chosen - 1)->power_so_far;
    const double rest = (wanted - before) / (chosen->power_so_far - before);
    const Surface& s = surfaces()[chosen->surface];
    const double root = std::sqrt(std::min(1.0, std::max(0.0, rest)));
    const Vector y = s.at(root * (1 - u[1]), root * u[1]);
    const Vector d = y - at;
    const double r2 = dot(d, d);
    const double cosine = dot(n, d), other = -dot(s.normal, d);  // both times r
    if (cosine <= 0 || other == 0 || (other < 0 && !s.two_sided)) return {};
    const Vector facing = other > 0 ? s.normal : s.normal * -1;
    if (tree_.blocked(start, y + facing * tree_.offset())) return {};
    const double by_cosine = cosine * std::fabs(other) / (pi * r2 * r2);
    return s.emission * (by_cosine / (by_cosine + density(s)));
  }

  static Vector cosine_direction(Vector n, const double* u) {
    const Vector axis = std::fabs(n.x) < 0.6 ? Vector{1, 0, 0} : Vector{0, 1, 0};
    const Vector t = normalized(cross(axis, n)), b = cross(n, t);
    const double r = std::sqrt(u[0]), angle = 2 * pi * u[1];
    return normalized(t * (r * std::cos(angle)) + b * (r * std::sin(angle)) +
                      n * std::sqrt(std::max(1e-12, 1 - u[0])));
  }

  RayTree tree_;
  uint64_t seed_;
  std::vector<Emitter> emitters_;
};

}  // namespace physics
