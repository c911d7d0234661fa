// Bounds of what clusters see of each other. Floor 6 (links).
#include "links/cluster_ends.h"

#include <algorithm>
#include <cmath>

namespace hrad {
namespace {

// Ends of a link with a cluster stand apart when their radii together are less than this share of
// the distance: sixteen pairs then tell the form factor to a few per cent.
constexpr double largest_ratio = 0.6;

// How far an end reaches from its center along n, of length 1.
double reach(const Element& end, Vec3 n) {
  const double along = std::fabs(dot(n, end.normal));
  const double thickness = end.cluster ? end.cluster->thickness : 0;
  return along * thickness + std::sqrt(std::max(0.0, 1 - along * along)) * end.radius;
}

// False where all of `other` lies behind all planes of `end`.
bool may_see(const Element& end, const Element& other, Vec3 to_other, double distance) {
  double height = dot(end.normal, to_other) + reach(other, end.normal);
  if (end.cluster) {
    if (!end.cluster->linkable()) return true;
    // The sine is no larger than the angle.
    height += end.cluster->thickness + end.cluster->cone * (distance + end.radius + other.radius);
  }
  return height > 0;
}

// Some of `other` lies before the plane of `element`.
bool is_before(const Element& element, const Element& other, double margin) {
  const double own = dot(element.normal, element.corners.a) + margin;
  return dot(element.normal, other.corners.a) > own || dot(element.normal, other.corners.b) > own ||
         dot(element.normal, other.corners.c) > own;
}

}  // namespace

Meeting meeting_of(const Element& receiver, const Element& source, double margin) {
  if (!receiver.cluster && !source.cluster)
    return is_before(receiver, source, margin) && is_before(source, receiver, margin)
               ? Meeting::link
               : Meeting::no_light;
  if (!(receiver.area > 0) || !(source.area > 0)) return Meeting::no_light;
  const Vec3 way = source.centroid - receiver.centroid;
  const double distance = length(way);
  if (!may_see(receiver, source, way, distance) || !may_see(source, receiver, -way, distance))
    return Meeting::no_light;
  const bool receiver_wide = receiver.cluster && !receiver.cluster->linkable();
  const bool source_wide = source.cluster && !source.cluster->linkable();
  const bool apart = receiver.radius + source.radius < largest_ratio * distance;
  if (apart && !receiver_wide && !source_wide) return Meeting::link;
  if (!source.cluster) return Meeting::split_receiver;
  if (!receiver.cluster) return Meeting::descend_source;
  if (receiver_wide != source_wide)
    return receiver_wide ? Meeting::split_receiver : Meeting::descend_source;
  return receiver.radius > source.radius ? Meeting::split_receiver : Meeting::descend_source;
}

}  // namespace hrad
