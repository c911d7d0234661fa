// Direct light at the corners of elements: which corners are asked for, their numbers, and their
// light once it has been sampled, all new ones of a step at once. Floor 7 (stages).
#pragma once

#include <cstdint>
#include <vector>

#include "base/growing_array.h"
#include "hierarchy/lattice.h"
#include "links/direct_light.h"
#include "machine/key_numbers.h"
#include "stages/corner_key.h"
#include "stages/state_memory.h"

namespace hrad {

// Three points of an element.
enum class PointsOf { corners, middles_of_edges, half_way_to_the_middle };
struct ElementPoints {
  NodeId element;
  PointsOf which;
};

// A point that is an element's own; `which` tells apart those of one element.
struct PointOfElement {
  NodeId element;
  int which;
  Vec3 place;
};

class CornerSampler {
 public:
  // All must outlive this. Empties state.direct.
  CornerSampler(State& state, const StageTools& tools, const DirectLight& light, LightGrid& grid,
                const Brightness& brightness, uint64_t seed);

  // Asks for the light at these points; asking twice is the same as once.
  void want(const std::vector<ElementPoints>& all);
  int64_t asked() const { return static_cast<int64_t>(sampled_ + wanted_.size()); }
  // For the progress that sample() reports: how many points there will be after those asked for so
  // far, roughly, in points that take as long as most.
  void expect(double later) { expected_ = work_ + static_cast<double>(wanted_.size()) + later; }
  // Samples what was asked for since the last time; false: stopped. work: of each of these points,
  // in such points.
  bool sample(double work = 1);
  // Of a sampled corner: its light in units of the scene's mean irradiance, negative when it is
  // sealed.
  double value(int32_t number) const { return value_[number]; }
  double value(int32_t surface, LatticePoint point) const { return value_[find(surface, point)]; }
  Span<const Link> links_of(int32_t number) const { return links_[number]; }
  // The number of a corner that may have been asked for, -1: it wasn't.
  int32_t find(int32_t surface, LatticePoint point) const {
    return number_.find(key_of_corner(surface, point));
  }

  // Asks for the light at points that are elements' own, whose numbers follow each other from
  // asked() on.
  void add(const std::vector<PointOfElement>& points);
  // The links of the points from number `first` on are not needed any more.
  void forget_links(size_t first);
  // Three points that have the mean of every quadratic field over the exposed part of an element
  // some of whose corners are sealed, as far as that part is a triangle or a quadrangle; or thrice
  // one exposed point within. False: nothing exposed was found. Any thread.
  bool points_of_exposed(NodeId element, const LatticePoint corner[3], Vec3 place[3]) const;

  // Fills state.direct with points and links, without the points that no leaf names, those that
  // only showed that nothing need be divided, and links from emitters that are not quite bright
  // where they were sampled. Once, at the end.
  void keep_what_is_named();

 private:
  struct Wanted {
    int32_t surface;
    uint64_t key, name;  // what it draws by, and as a task
    Vec3 place;
  };
  Wanted wanted_of(uint64_t key) const;
  Wanted own_of(const PointOfElement& point) const;
  OrientedPoint point_of(const Wanted& wanted) const;
  bool sample_some(size_t first, size_t end, double work);
  void count_links(size_t more);
  void count_memory();
  Vec3 point_of(int32_t surface, LatticePoint point) const;
  Vec3 moved_inwards(int32_t surface, Vec3 on) const;
  bool is_sealed(int32_t surface, Vec3 place) const;
  Vec3 border(int32_t surface, Vec3 exposed, Vec3 sealed) const;
  bool exposed_within(const Node& node, Vec3* place) const;

  State& state_;
  const StageTools& tools_;
  const Brightness& brightness_;
  LightGrid& grid_;
  const DirectLight& light_;
  const uint64_t seed_;
  KeyNumbers number_;
  GrowingArray<Wanted> wanted_;
  size_t sampled_ = 0;         // points that have been
  GrowingArray<float> value_;  // per point, as what follows
  GrowingArray<Span<Link>> links_;
  struct Place {
    float x, y, z;
    int32_t surface;
  };
  GrowingArray<Place> place_;  // roughly
  struct Part {                // of the points from one number on, what their links lie in
    size_t first;
    std::vector<Link> links;
  };
  std::vector<Part> parts_;
  size_t link_count_ = 0;
  StageMemory memory_;  // of all these
  int64_t counted_ = 0;
  double work_ = 0, expected_ = 0;  // done, and in all
};

}  // namespace hrad
