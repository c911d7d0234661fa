// Exposure and curve (tone_map.h). CLI: public headers only.
#include "render/tone_map.h"

namespace hrad::cli {
namespace {

constexpr double bright_share = 0.9, light_of_bright = 0.5;

// Proportional up to the shoulder; above, an exponential with the same slope nears white.
constexpr double shoulder = 0.6;

double curve(double light) {
  if (light <= shoulder) return std::max(0.0, light);
  return 1 - (1 - shoulder) * std::exp(-(light - shoulder) / (1 - shoulder));
}

}  // namespace

double percentile(std::vector<double>* values, double share) {
  if (values->empty()) return 0;
  const auto at = static_cast<size_t>(share * static_cast<double>(values->size() - 1));
  std::nth_element(values->begin(), values->begin() + static_cast<std::ptrdiff_t>(at),
                   values->end());
  return (*values)[at];
}

double ToneMap::scale_for(SeenValues seen) {
  double bright = percentile(&seen.lit, bright_share);
  if (!(bright > 0)) bright = percentile(&seen.emitting, bright_share);
  return bright > 0 ? light_of_bright / bright : 1;
}

Colour ToneMap::operator()(const double* bands, size_t count) const {
  if (count == 3)
    return {curve(scale_ * bands[0]), curve(scale_ * bands[1]), curve(scale_ * bands[2])};
  double sum = 0;
  for (size_t band = 0; band < count; ++band) sum += bands[band];
  const double light = curve(scale_ * sum / static_cast<double>(count));
  return {light, light, light};
}

}  // namespace hrad::cli
