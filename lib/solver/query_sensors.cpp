// Irradiance at free points, by as many rays as it takes to know it. Floor 8 (solver).
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/hash.h"
#include "solver/ray_gather.h"
#include "solver/solution.h"

namespace hrad {
namespace {

// Sets of rays that know nothing of each other: their spread is the standard error.
constexpr int sets = 16;
// Samples of a set. From the first number on the spread says something; each further step doubles
// what there is.
constexpr int fewest_samples = 2, most_samples = 256;
// What a standard error may be of the irradiance, in shares of the accuracy.
constexpr double share_of_accuracy = 0.25;

class Sensor {
 public:
  Sensor(const RayGather& gather, int bands, Vec3 place, Vec3 normal, uint64_t seed)
      : gather_(gather), bands_(bands), place_(place), normal_(normal) {
    Hasher key;
    key.add(seed);
    for (int axis = 0; axis < 3; ++axis) {
      key.add(place[axis]);
      key.add(normal[axis]);
    }
    key_ = key.value();
  }

  void read(double accuracy, RayGather::NearEmitters& space) {
    Element point;
    point.centroid = place_;
    point.normal = normal_;
    const Draw& emitters = gather_.emitters_near(point, space);
    // Where little arrives, too, the noise of n rays is no larger than about 1/sqrt(n) of what
    // arrives elsewhere.
    const double wanted = 1 / (share_of_accuracy * share_of_accuracy * accuracy * accuracy);
    const int most = std::max(4, static_cast<int>(std::min<double>(
                                     most_samples, wanted / (sets * RayGather::shadow_rays))));
    for (int samples = fewest_samples; samples_ < most; samples *= 2) {
      add(std::min(samples, most), emitters);
      if (is_known(share_of_accuracy * accuracy)) return;
    }
  }

  void write(double* irradiance, double* standard_error) const {
    for (int b = 0; b < bands_; ++b) {
      irradiance[b] = mean(b);
      if (standard_error) standard_error[b] = std::sqrt(variance(b));
    }
  }

 private:
  void add(int samples, const Draw& emitters) {
    for (int set = 0; set < sets; ++set)
      for (int k = samples_; k < samples; ++k) {
        double value[most_bands];
        gather_.sample(place_, normal_, mix(key_, static_cast<uint64_t>(set)),
                       static_cast<uint32_t>(k), RayGather::shadow_rays, emitters, value);
        for (int b = 0; b < bands_; ++b) sums_[set][b] += value[b];
      }
    samples_ = samples;
  }

  // Where nothing was met it may be that what little there is was missed.
  bool is_known(double error) const {
    double of_means = 0, of_errors = 0;
    for (int b = 0; b < bands_; ++b) {
      of_means += mean(b) * mean(b);
      of_errors += variance(b);
    }
    return of_means > 0 && of_errors <= error * error * of_means;
  }

  double mean(int b) const {
    double sum = 0;
    for (const auto& of_set : sums_) sum += of_set[b];
    return sum / (sets * samples_);
  }

  // Of the mean.
  double variance(int b) const {
    const double middle = mean(b);
    double squares = 0;
    for (const auto& of_set : sums_) {
      const double apart = of_set[b] / samples_ - middle;
      squares += apart * apart;
    }
    return squares / (sets * (sets - 1));
  }

  const RayGather& gather_;
  const int bands_;
  const Vec3 place_, normal_;
  uint64_t key_ = 0;
  int samples_ = 0;  // of each set
  double sums_[sets][most_bands] = {};
};

// Of a vector of any length but 0, however large or small.
Vec3 direction_of(const double* v) {
  const double largest = std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
  return normalized({v[0] / largest, v[1] / largest, v[2] / largest});
}

}  // namespace

void Solver::query_sensors(int64_t count, const double* xyz, const double* normal,
                           double* irradiance, double* standard_error) const {
  require_solved();
  const int bands = scene_.bands;
  comm_->all_go_on();
  const RayGather gather(solution_->state, radiosity_of_all(), *solution_->engine);
  ThreadTeam& team = *solution_->team;
  std::vector<RayGather::NearEmitters> spaces(static_cast<size_t>(team.size()));
  team.for_each(count, [&](int64_t k, int worker) {
    Sensor sensor(gather, bands, {xyz[3 * k], xyz[3 * k + 1], xyz[3 * k + 2]},
                  direction_of(normal + 3 * k), static_cast<uint64_t>(params_.seed));
    sensor.read(params_.accuracy, spaces[static_cast<size_t>(worker)]);
    sensor.write(irradiance + k * bands, standard_error ? standard_error + k * bands : nullptr);
  });
}

}  // namespace hrad
