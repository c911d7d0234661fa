// Whether there may be a link with a cluster at an end. Floor 6 (links).
#pragma once

#include "links/element.h"

namespace hrad {

// What the geometry alone says about a link between two ends.
enum class Meeting { no_light, link, split_receiver, descend_source };

// Two elements that face each other always may be linked. With a cluster both ends must look one
// way and stand apart; the larger one is refined otherwise, as far as it is a cluster. margin: what
// lies no higher above a plane isn't before it.
Meeting meeting_of(const Element& receiver, const Element& source, double margin);

}  // namespace hrad
