// Irradiance by path tracing for scenes with many emitters: direct light takes an emitter with a
// probability that follows its unoccluded light at the shading point, and combines that with the
// cosine-distributed ray by the balance heuristic (Veach and Guibas 1995). It shares nothing with
// lib/ but the scene.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bench/covers.h"
#include "physics/ray_tree.h"

namespace bench {

using physics::Hit;
using physics::Random;
using physics::RayTree;
using physics::Spectrum;
using physics::Surface;
using physics::Vector;

// What the first vertex of a path draws; low-discrepancy points fill it.
struct FirstDraws {
  double direction[2], emitter, place[2];
};

// The emitters as one shading point sees them: running sums of their weights.
struct EmitterChoice {
  std::vector<double> so_far;
  double total() const { return so_far.empty() ? 0 : so_far.back(); }
  double weight(size_t emitter) const {
    return so_far[emitter] - (emitter == 0 ? 0 : so_far[emitter - 1]);
  }
};

class PathTracer {
 public:
  explicit PathTracer(std::vector<Surface> surfaces)
      : tree_(std::move(surfaces)), covers_(tree_.surfaces()) {
    emitter_of_.assign(this->surfaces().size(), -1);
    for (size_t i = 0; i < this->surfaces().size(); ++i) {
      const Surface& s = this->surfaces()[i];
      if (!s.emits()) continue;
      const Vector center = (s.a + s.b + s.c) * (1.0 / 3);
      double radius = 0;
      for (const Vector& p : {s.a, s.b, s.c}) radius = std::max(radius, length(p - center));
      emitter_of_[i] = static_cast<int64_t>(emitters_.size());
      emitters_.push_back({static_cast<int64_t>(i), center, s.normal, radius,
                           s.area * physics::sum(s.emission), s.two_sided});
    }
  }

  const std::vector<Surface>& surfaces() const { return tree_.surfaces(); }
  size_t emitter_count() const { return emitters_.size(); }

  void choose(Vector at, Vector n, EmitterChoice& choice) const {
    choice.so_far.resize(emitters_.size());
    double total = 0;
    for (size_t i = 0; i < emitters_.size(); ++i)
      choice.so_far[i] = total += weight(emitters_[i], at, n);
  }

  // One path from a point with a normal: an unbiased estimate of its irradiance. `choice` is that
  // point's.
  Spectrum irradiance(Vector at, Vector n, const EmitterChoice& choice, const FirstDraws& first,
                      Random& random) const {
    Spectrum light, throughput = physics::gray(1);
    FirstDraws draws = first;
    const EmitterChoice* seen = &choice;
    for (;;) {
      const Vector start = at + n * tree_.offset();
      light = light + throughput * direct(at, start, n, *seen, draws);
      const Vector direction = cosine_direction(n, draws.direction);
      const Hit hit = tree_.nearest(start, direction);
      if (hit.surface < 0 || hit.black) return light;
      const Surface& s = surfaces()[hit.surface];
      const Vector facing = hit.back ? s.normal * -1 : s.normal;
      if (s.emits()) {
        const double by_cosine =
            dot(n, direction) * -dot(facing, direction) / (physics::pi * hit.t * hit.t);
        const double by_choice = density(*seen, hit.surface);
        light = light + throughput * s.emission * (by_cosine / (by_cosine + by_choice));
      }
      // Absorption ends the path; what survives carries the ratio of the bands on.
      const double survival = physics::largest(s.reflectance);
      if (random.uniform() >= survival) return light;
      throughput = throughput * s.reflectance * (1 / survival);
      at = start + direction * hit.t;
      n = facing;
      choose(at, n, scratch_);
      seen = &scratch_;
      draws = {{random.uniform(), random.uniform()},
               random.uniform(),
               {random.uniform(), random.uniform()}};
    }
  }

  const Covers& covers() const { return covers_; }

  // No ray from the point meets a lit side: it lies inside a contact. Deep gaps are no contacts,
  // though paths may bring no light from them.
  bool sealed(Vector at, Vector n) const {
    constexpr int rays = 256;
    Random random(1);
    for (int i = 0; i < rays; ++i) {
      const double u[2] = {random.uniform(), random.uniform()};
      const Hit hit = tree_.nearest(at + n * tree_.offset(), cosine_direction(n, u));
      if (hit.surface >= 0 && !hit.black) return false;
    }
    return true;
  }

 private:
  struct Emitter {
    int64_t surface;
    Vector center, normal;
    double radius;
    double power;  // of one side, all bands together
    bool two_sided;
  };

  // About the unoccluded light of an emitter at a point, 0 only where it can send none. A floor
  // under the cosines keeps near emitters that are seen in part from being neglected.
  static double weight(const Emitter& e, Vector at, Vector n) {
    const Vector d = e.center - at;
    const double above = dot(n, d);
    if (above <= -e.radius) return 0;
    const double height = -dot(e.normal, d);
    if (height <= 0 && !e.two_sided) return 0;
    const double square = dot(d, d) + e.radius * e.radius;
    const double cosines = std::max(0.0, above) * std::fabs(height);
    return e.power * (cosines + 0.02 * square) / (square * square);
  }

  // Probability per area with which a point of an emitter is drawn.
  double density(const EmitterChoice& choice, int64_t surface) const {
    if (choice.total() <= 0) return 0;
    const size_t emitter = static_cast<size_t>(emitter_of_[surface]);
    return choice.weight(emitter) / (choice.total() * surfaces()[surface].area);
  }

  Spectrum direct(Vector at, Vector start, Vector n, const EmitterChoice& choice,
                  const FirstDraws& draws) const {
    if (choice.total() <= 0) return {};
    const double wanted = draws.emitter * choice.total();
    const auto chosen = std::upper_bound(choice.so_far.begin(), choice.so_far.end() - 1, wanted);
    const Emitter& e = emitters_[static_cast<size_t>(chosen - choice.so_far.begin())];
    const Surface& s = surfaces()[e.surface];
    const double root = std::sqrt(draws.place[0]);
    const Vector y = s.at(root * (1 - draws.place[1]), root * draws.place[1]);
    const Vector d = y - at;
    const double square = dot(d, d);
    const double cosine = dot(n, d), other = -dot(s.normal, d);  // both times the distance
    if (cosine <= 0 || other == 0 || (other < 0 && !s.two_sided)) return {};
    const Vector facing = other > 0 ? s.normal : s.normal * -1;
    if (tree_.blocked(start, y + facing * tree_.offset())) return {};
    const double by_cosine = cosine * std::fabs(other) / (physics::pi * square * square);
    const double by_choice = density(choice, e.surface);
    return by_choice > 0 ? s.emission * (by_cosine / (by_cosine + by_choice)) : Spectrum{};
  }

  static Vector cosine_direction(Vector n, const double* u) {
    const Vector axis = std::fabs(n.x) < 0.6 ? Vector{1, 0, 0} : Vector{0, 1, 0};
    const Vector t = normalized(cross(axis, n)), b = cross(n, t);
    const double r = std::sqrt(u[0]), angle = 2 * physics::pi * u[1];
    return normalized(t * (r * std::cos(angle)) + b * (r * std::sin(angle)) +
                      n * std::sqrt(std::max(1e-12, 1 - u[0])));
  }

  RayTree tree_;
  Covers covers_;
  std::vector<Emitter> emitters_;
  std::vector<int64_t> emitter_of_;  // per surface, -1: dark
  mutable EmitterChoice scratch_;    // of the vertices after the first
};

}  // namespace bench
