// The reference of a scene: irradiance at random points and its means over patches, with variances,
// improved pass by pass for as long as one likes. Every pass adds replicates: sets of shifted
// low-discrepancy paths, whose spread tells the variance. The same passes give the same numbers.
#pragma once

#include <cstdint>
#include <cstring>
#include <numeric>

#include "bench/path_tracer.h"
#include "bench/user_time.h"

namespace bench {

constexpr int kPathsPerReplicate = 32;

// A point of a side of a surface, or the side as a whole.
struct Target {
  int64_t surface = 0;
  int64_t side = 0;       // 0 front, 1 back
  double u = -1, v = -1;  // u < 0: the side as a whole
  double weight = 0;      // area that it stands for
  double share = 1;       // replicates per pass, about
  int64_t replicates = 0;
  Spectrum sum, squares;  // of the means of the replicates

  bool is_point() const { return u >= 0; }
  Spectrum mean() const { return sum * (1.0 / static_cast<double>(replicates)); }
  Spectrum variance() const {  // of the mean
    Spectrum result;
    const double n = static_cast<double>(replicates);
    for (int k = 0; k < physics::max_bands; ++k) {
      const double spread = squares[k] / n - sum[k] / n * (sum[k] / n);
      result[k] = std::max(0.0, spread) / (n - 1);
    }
    return result;
  }
  bool is_dark() const { return physics::sum(sum) == 0; }  // no path brought light
};

struct TargetSet {
  std::vector<Target> targets;
  int64_t passes = 0;
  double seconds = 0;     // user CPU spent on the passes
  int64_t is_sample = 0;  // 1: targets were drawn at random, 0: they are all there are
};

// The dark sides of the scene, all or a sample of about `most`: large ones surely, of the others
// one for each stratum of area in the order of the patches.
inline TargetSet side_targets(const std::vector<Surface>& surfaces, int64_t most, uint64_t seed) {
  std::vector<Target> all;
  for (size_t i = 0; i < surfaces.size(); ++i) {
    for (int side = 0; side < surfaces[i].sides() && !surfaces[i].emits(); ++side) {
      Target t;
      t.surface = static_cast<int64_t>(i);
      t.side = side;
      t.weight = surfaces[i].area;
      all.push_back(t);
    }
  }
  TargetSet set;
  if (static_cast<int64_t>(all.size()) <= most) {
    set.targets = std::move(all);
    return set;
  }
  set.is_sample = 1;
  std::vector<size_t> order(all.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t l, size_t r) { return all[l].weight > all[r].weight; });
  double area = 0;
  for (const Target& t : all) area += t.weight;
  size_t sure = 0;
  while (static_cast<int64_t>(sure) < most &&
         all[order[sure]].weight * static_cast<double>(most - static_cast<int64_t>(sure)) >= area)
    area -= all[order[sure++]].weight;
  std::vector<char> taken(all.size(), 0);
  for (size_t i = 0; i < sure; ++i) taken[order[i]] = 1;

  Random random(seed);
  const double stratum = area / static_cast<double>(most - static_cast<int64_t>(sure));
  double end = 0;  // of the running target in the order of areas
  double next = stratum * random.uniform();
  int64_t strata = 1;
  for (size_t i = 0; i < all.size(); ++i) {
    if (taken[i]) {
      set.targets.push_back(all[i]);
      continue;
    }
    end += all[i].weight;
    double weight = 0;
    for (; next < end; ++strata) {
      weight += stratum;
      next = stratum * (static_cast<double>(strata) + random.uniform());
    }
    if (weight == 0) continue;
    set.targets.push_back(all[i]);
    set.targets.back().weight = weight;
  }
  return set;
}

// Points drawn by area from the dark sides, one for each of `count` strata.
inline TargetSet point_targets(const std::vector<Surface>& surfaces, int64_t count, uint64_t seed) {
  const std::vector<Target> sides =
      side_targets(surfaces, std::numeric_limits<int64_t>::max(), seed).targets;
  TargetSet set;
  set.is_sample = 1;
  if (sides.empty()) return set;
  std::vector<double> area_so_far;
  double area = 0;
  for (const Target& t : sides) area_so_far.push_back(area += t.weight);
  Random random(seed);
  for (int64_t i = 0; i < count; ++i) {
    const double stratum = area / static_cast<double>(count);
    const double wanted = stratum * (static_cast<double>(i) + random.uniform());
    const auto chosen = std::upper_bound(area_so_far.begin(), area_so_far.end() - 1, wanted);
    Target t = sides[static_cast<size_t>(chosen - area_so_far.begin())];
    const double root = std::sqrt(random.uniform()), other = random.uniform();
    t.u = root * (1 - other);
    t.v = root * other;
    t.weight = stratum;
    set.targets.push_back(t);
  }
  return set;
}

// Adds replicates to targets. `kind` keeps the random streams of the sets apart.
class Sampler {
 public:
  Sampler(const PathTracer& tracer, uint64_t seed, uint64_t kind)
      : tracer_(tracer), seed_(Random::mixed(seed ^ Random::mixed(kind))) {
    // The powers of the root of g^8 = g + 1: seven draws for the first vertex.
    double root = 1.1;
    for (int i = 0; i < 60; ++i) root = std::pow(1 + root, 1.0 / 8);
    for (size_t k = 0; k < steps_.size(); ++k)
      steps_[k] = std::pow(root, -static_cast<double>(k + 1));
  }

  // One more pass over a set. Before the first a pilot, whose samples are thrown away, decides how
  // the paths are shared out: n ~ sqrt(weight) x deviation of the reflected light.
  void pass(TargetSet& set) const {
    const double start = user_seconds();
    if (set.passes == 0) share_out(set);
    for (size_t i = 0; i < set.targets.size(); ++i) {
      Target& t = set.targets[i];
      const int64_t wanted = 2 + static_cast<int64_t>(t.share * static_cast<double>(set.passes));
      add(t, i, wanted - t.replicates);
    }
    ++set.passes;
    set.seconds += user_seconds() - start;
  }

 private:
  void share_out(TargetSet& set) const {
    constexpr int64_t pilots = 2;
    constexpr double least = 0.25;  // of the mean share
    double total = 0;
    for (size_t i = 0; i < set.targets.size(); ++i) {
      Target& t = set.targets[i];
      Target pilot = t;
      pilot.replicates = -pilots;  // streams of their own
      add(pilot, i, pilots);
      pilot.replicates = pilots;
      const Spectrum& rho = tracer_.surfaces()[t.surface].reflectance;
      t.share = std::sqrt(t.weight * physics::sum(pilot.variance() * rho * rho));
      total += t.share;
    }
    const double mean = total / static_cast<double>(set.targets.size());
    for (Target& t : set.targets) t.share = least + (1 - least) * (mean > 0 ? t.share / mean : 1);
  }

  void add(Target& t, size_t index, int64_t count) const {
    if (count <= 0) return;
    const Surface& s = tracer_.surfaces()[t.surface];
    const Vector n = t.side == 0 ? s.normal : s.normal * -1;
    EmitterChoice choice;
    Vector at = t.is_point() ? s.at(t.u, t.v) : Vector{};
    if (t.is_point()) tracer_.choose(at, n, choice);
    for (int64_t r = 0; r < count; ++r, ++t.replicates) {
      Random random(seed_ ^
                    Random::mixed(index * 0x100000001b3u + static_cast<uint64_t>(t.replicates)));
      std::array<double, 7> x;
      for (double& value : x) value = random.uniform();
      Spectrum batch;
      for (int i = 0; i < kPathsPerReplicate; ++i) {
        if (!t.is_point()) {
          const double root = std::sqrt(x[5]);
          at = s.at(root * (1 - x[6]), root * x[6]);
          tracer_.choose(at, n, choice);
        }
        const FirstDraws first = {{x[0], x[1]}, x[2], {x[3], x[4]}};
        if (!tracer_.covers().covered(static_cast<size_t>(t.surface), t.side, at))
          batch = batch + tracer_.irradiance(at, n, choice, first, random);
        for (size_t k = 0; k < x.size(); ++k) {
          x[k] += steps_[k];
          x[k] -= std::floor(x[k]);
        }
      }
      batch = batch * (1.0 / kPathsPerReplicate);
      t.sum = t.sum + batch;
      t.squares = t.squares + batch * batch;
    }
  }

  const PathTracer& tracer_;
  uint64_t seed_;
  std::array<double, 7> steps_;
};

}  // namespace bench
