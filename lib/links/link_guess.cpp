// Discs, and the gradient of the kernel between them. Floor 6 (links).
#include "links/link_guess.h"

#include <algorithm>
#include <cmath>

#include "base/angle.h"

namespace hrad {
namespace {

// Half the range over half the mean: no kernel varies by more than twice its mean where clusters
// may be linked, and elements nearer than that are split anyway.
constexpr double largest_variation = 2;
// Share of the angle that an end subtends, or its normals spread over, by which its cosine may be
// larger than that of the middle.
constexpr double blur = 0.3;
constexpr double largest_ratio = 1e6;

}  // namespace

LinkGuess guess_of(const Element& receiver, const Element& source) {
  const Vec3 way = source.centroid - receiver.centroid;
  const double square = dot(way, way), distance = std::sqrt(square);
  const double size = receiver.radius + source.radius;
  LinkGuess guess;
  guess.ratio = size < largest_ratio * distance ? size / distance : largest_ratio;
  const auto cosine = [&](const Element& end, double along) {
    const double spread = std::min(2.0, guess.ratio) + (end.cluster ? end.cluster->cone : 0);
    const double middle = distance > 0 ? along / distance : 1;
    return std::min(1.0, std::max(0.0, middle) + blur * spread);
  };
  const double at_receiver = cosine(receiver, dot(way, receiver.normal));
  const double at_source = cosine(source, -dot(way, source.normal));
  const double area = source.exposed_area();
  guess.factor = area * at_receiver * at_source / (pi * square + area);
  // The cosines vary the more the nearer an end is to the other's horizon.
  double relative = largest_variation;
  if (receiver.radius < largest_ratio * distance && at_receiver * at_source > 0)
    relative = 0.5 * receiver.radius / distance * (2 + 1 / at_receiver + 1 / at_source);
  if (receiver.cluster) relative += receiver.cluster->cone;
  guess.variation = guess.factor * std::min(largest_variation, relative);
  return guess;
}

}  // namespace hrad
