// Cosine-distributed rays from the exposed part of an element, spread evenly over it and its
// hemisphere. Floor 7 (stages).
#pragma once

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
        exposure_(exposure),
        offset_(engine.offset()),
        is_whole_(!(element.exposed < 1)),
        left_(wanted),
        places_left_(is_whole_ ? wanted : 64 * wanted) {}

  // False: there are no more.
  bool next(Ray& ray) {
    while (left_ > 0 && places_left_ > 0) {
      --places_left_;
      double p[4];
      points_.point(number_++, p);
      even_in_triangle(p[0], p[1], &ray.x, &ray.y);
      const Vec3 on = corners_.at(ray.x, ray.y);
      // Points on a sealed part see nothing: what is wanted is that of the exposed part.
      if (!is_whole_ && exposure_.sealed(surface_.patch, surface_.side, on)) continue;
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
  const Exposure& exposure_;
  const double offset_;
  const bool is_whole_;
  int left_, places_left_;
  uint32_t number_ = 0;
};

}  // namespace hrad
