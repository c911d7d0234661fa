// The form factor of a link as the geometry of its ends suggests, without a sample: what decisions
// about rough links rest on, so that chance has no part in them. Floor 6 (links).
#pragma once

#include "links/element.h"

namespace hrad {

struct LinkGuess {
  double factor = 0;     // of discs, about an upper bound
  double variation = 0;  // half its range over the receiver
  double ratio = 0;      // radii over distance
};
LinkGuess guess_of(const Element& receiver, const Element& source);

}  // namespace hrad
