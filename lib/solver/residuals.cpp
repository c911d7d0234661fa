// Every half of every measurement of a patch is independent of all others: the product of two of
// their differences has the square of the true one as its mean, without a bias by noise. Where a
// patch was measured n times so are all pairs, whose noise falls with n squared. Floor 8 (solver).
#include "solver/residuals.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hrad {
namespace {

// Even steps meet a patch as often as expected or once more or less: the variance of that, at most.
constexpr double variance_of_count = 0.25;

double sum_of(const Residual& r) {
  return std::accumulate(r.difference, std::end(r.difference), 0.0) / 2;
}

// Of one patch, over all times that it was measured.
struct Measured {
  double times = 0;
  double square = 0, noise_of_square = 0;  // of the true difference; the variance of that
  double difference = 0, noise_of_difference = 0;
  double solved = 0, solved_sum = 0;
};

// residuals: all of one patch.
Measured measured(const std::vector<const Residual*>& residuals) {
  Measured m;
  m.times = static_cast<double>(residuals.size());
  m.solved = residuals.front()->solved;
  m.solved_sum = residuals.front()->solved_sum;
  const double halves = 2 * m.times;
  double sum[most_bands] = {}, squares = 0, square_of_sum = 0, spread = 0;
  for (const Residual* r : residuals) {
    for (int b = 0; b < most_bands; ++b) sum[b] += r->difference[b];
    squares += r->squares;
    m.difference += sum_of(*r) / m.times;
  }
  for (double s : sum) square_of_sum += s * s;
  m.square = (square_of_sum - squares) / (halves * (halves - 1));
  // As if all bands went together.
  const double variance = std::max(0.0, squares - square_of_sum / halves) / (halves - 1);
  m.noise_of_square = 2 * variance * variance / (halves * (halves - 1)) +
                      4 * std::max(0.0, m.square) * variance / halves;
  for (const Residual* r : residuals)
    spread += (sum_of(*r) - m.difference) * (sum_of(*r) - m.difference);
  if (m.times > 1) m.noise_of_difference = spread / (m.times * (m.times - 1));
  return m;
}

// The variance of times * worth * value. What was drawn once might as well not have been.
double variance_of(const Measured& m, double worth, double deviation, double noise) {
  const double drawn = m.times > 1 ? variance_of_count : 1;
  const double measured = m.times > 1 ? m.times * m.times * noise : 0;
  return worth * worth * (drawn * deviation * deviation + measured);
}

}  // namespace

MeasuredError error_of(const std::vector<DrawnPatch>& drawn, const std::vector<Residual>& residuals,
                       double returned) {
  std::vector<size_t> order(drawn.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return drawn[a].number < drawn[b].number; });
  std::vector<Measured> patches;
  std::vector<double> worths;
  double square = 0, solved = 0, difference = 0, solved_sum = 0;
  std::vector<const Residual*> of_patch;
  for (size_t k = 0; k < order.size(); ++k) {
    const DrawnPatch& patch = drawn[order[k]];
    of_patch.push_back(&residuals[order[k]]);
    if (k + 1 < order.size() && drawn[order[k + 1]].number == patch.number) continue;
    const Measured m = measured(of_patch);
    const double weight = m.times * patch.worth;
    square += weight * m.square;
    solved += weight * m.solved;
    difference += weight * m.difference;
    solved_sum += weight * m.solved_sum;
    patches.push_back(m);
    worths.push_back(patch.worth);
    of_patch.clear();
  }
  if (!(solved > 0)) return {};
  const double mean_square = square / solved, bias = difference / solved_sum;
  double spread_of_square = 0, spread_of_bias = 0;
  for (size_t k = 0; k < patches.size(); ++k) {
    const Measured& m = patches[k];
    spread_of_square +=
        variance_of(m, worths[k], m.square - mean_square * m.solved, m.noise_of_square);
    spread_of_bias +=
        variance_of(m, worths[k], m.difference - bias * m.solved_sum, m.noise_of_difference);
  }
  spread_of_square /= solved * solved;
  spread_of_bias /= solved_sum * solved_sum;
  // The mean error is reflected on and on, the rest averages out at the next bounce. The square of
  // a noisy mean is too large by its variance.
  const double gain = 1 / ((1 - returned) * (1 - returned)) - 1;
  const double variance = std::max(0.0, mean_square + gain * (bias * bias - spread_of_bias));
  MeasuredError result;
  result.error = std::sqrt(variance);
  const double error_of_square = std::sqrt(
      spread_of_square + gain * gain * spread_of_bias * (4 * bias * bias + 2 * spread_of_bias));
  result.standard_error =
      std::min(std::sqrt(error_of_square), error_of_square / (2 * std::max(result.error, 1e-12)));
  return result;
}

}  // namespace hrad
