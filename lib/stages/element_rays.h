// Cosine-distributed rays from the exposed part of an element, spread evenly over it and its
// hemisphere. Floor 7 (stages).
#pragma once

#include <optional>

#include "base/frame.h"
#include "base/low_discrepancy.h"
#include "base/triangle_points.h"
#include "hierarchy/forest.h"
#include "visibility/exposure.h"
#include "visibility/visibility.h"

namespace hrad {

class ElementRays {
 public:
  struct Ray {
    double x, y;  // where in the element it begins
    Vec3 origin, direction;
  };

  // At the most so many, fewer where nearly all of the element is sealed. All must outlive this.
  ElementRays(const Forest& forest, const Exposure& exposure, const VisibilityEngine& engine,
              const Node& element, uint64_t key, int wanted)
      : surface_(forest.surfaces[element.surface]),
        corners_(forest.triangle(element)),
        frame_(surface_.normal),
        points_(key),
        offset_(engine.offset()),
        left_(wanted),
        places_left_(wanted) {
    if (!(element.exposed < 1)) return;
    part_.emplace(exposure, surface_.patch, surface_.side, corners_);
    places_left_ = 64 * wanted;
  }

  // False: there are no more.
  bool next(Ray& ray) {
    while (left_ > 0 && places_left_ > 0) {
      --places_left_;
      double p[4];
      points_.point(number_++, p);
      even_in_triangle(p[0], p[1], &ray.x, &ray.y);
      const Vec3 on = corners_.at(ray.x, ray.y);
      // Points on a sealed part see nothing: what is wanted is that of the exposed part.
      if (part_ && part_->sealed(on)) continue;
      ray.origin = on + surface_.normal * offset_;
      ray.direction = frame_.cosine_direction(p[2], p[3]);
      --left_;
      return true;
    }
    return false;
  }

 private:
  const Surface& surface_;
  const Triangle corners_;
  const Frame frame_;
  const LowDiscrepancy points_;
  std::optional<Exposure::Part> part_;  // of an element that is partly sealed
  const double offset_;
  int left_, places_left_;
  uint32_t number_ = 0;
};

}  // namespace hrad
