// The exposure rule: which points of a patch are sealed, pressed against another surface or inside
// a closed solid, so that no light gets in or out. A partly sealed element averages darkness into
// what others see of it unless its exposed part is kept apart. Floor 4 (visibility).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "scene/scene.h"
#include "scene/solids.h"
#include "visibility/visibility.h"

namespace hrad {

class Exposure {
 public:
  // Scene, engine must outlive this.
  Exposure(const Scene& scene, const VisibilityEngine& engine);
  ~Exposure();

  // False: no point of this side can be sealed.
  bool can_be_sealed(int64_t patch, int32_t side) const;

  // The point (in the scene's coordinates, on the patch) is sealed on this side. Any thread.
  bool sealed(int64_t patch, int32_t side, Vec3 point) const;

  // What may seal points of one element of a side, for many questions about it by one thread.
  class Part {
   public:
    // corners: the element's.
    Part(const Exposure& exposure, int64_t patch, int32_t side, const Triangle& corners);
    bool can_be_sealed() const { return !covers_.empty() || !solids_.empty(); }
    bool sealed(Vec3 point);
    // Share of it that is pressed against other surfaces, if no two of them overlap.
    double pressed_share() const;

   private:
    struct Cover {
      Box box;  // Exposure::cover_boxes_
      Triangle corners;
      Vec3 ab, bc, ca, normal;
      bool over(Vec3 point) const;
    };
    const Exposure* exposure_;
    Triangle corners_;
    Vec3 normal_;
    std::vector<Cover> covers_;
    std::vector<Box> solids_;
    size_t last_ = 0;  // the cover over the last point: the next one often lies under it too
  };

  // A surface that faces the same way lies on this point, as a rug on a floor: what would arrive
  // here arrives there. Any thread.
  bool overlaid(int64_t patch, int32_t side, Vec3 point) const;
  // The back of something lies flat on this point: a ray that ends here met that black back. Any
  // thread.
  bool under_a_back(int64_t patch, int32_t side, Vec3 point) const {
    return sealed(patch, side, point) && !overlaid(patch, side, point);
  }
  // The same by contact alone, solids left aside.
  bool pressed(int64_t patch, int32_t side, Vec3 point) const;

 private:
  Vec3 normal_of(int64_t patch, int32_t side) const;
  bool covered(int64_t cover, Vec3 point) const;
  bool inside_solid(int64_t patch, int32_t side, Vec3 point) const;
  bool enclosed(Vec3 origin, Vec3 normal) const;

  const Scene& scene_;
  const VisibilityEngine& engine_;
  Solids solids_;
  // For every side of a patch (2*patch+side) its run of covers_ and of enclosing_.
  std::vector<int64_t> first_cover_, first_enclosing_;
  std::vector<int32_t> covers_;     // patches pressed against it
  std::vector<Box> cover_boxes_;    // theirs, a little larger: most points lie outside most of them
  std::vector<int32_t> enclosing_;  // solids whose box it reaches into
};

}  // namespace hrad
