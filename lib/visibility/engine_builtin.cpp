// The builtin engine: our own tree and kernels, so that visibility, which is
// part of the result, does not change with a library's version. Floor 4
// (visibility).
#include <algorithm>
#include <cmath>

#include "visibility/engines.h"
#include "visibility/exact_hit.h"
#include "visibility/kernels.h"
#include "visibility/tree_build.h"

namespace hrad {

namespace {

// In scene radii: more than single precision rounds a place on a ray, less than
// a quarter of offset().
constexpr double single_precision = 1e-6;
// In scene radii: planes that lie this close along the ray are equally near,
// and the lowest patch wins.
constexpr double tie = 1e-12;

class BuiltinEngine final : public VisibilityEngine {
 public:
  BuiltinEngine(const Scene& scene, const Kernels& kernels, ThreadTeam& team)
      : scene_(scene), kernels_(kernels) {
    measure_scene(scene, center_, radius_);
    const float padding = static_cast<float>(single_precision * radius_);
    tree_ = build_tree(scene, center_, padding, team);
    view_ = {tree_.nodes.data(), tree_.leaves.data(), padding};
  }

  uint32_t blocked(const SegmentPacket& packet) const override {
    return kernels_.blocked(view_, packet);
  }

  Hit nearest(Vec3 origin, Vec3 direction, double t_min) const override;

  const char* name() const override { return "builtin"; }
  std::string version() const override { return "1"; }
  int64_t bytes() const override {
    return static_cast<int64_t>(tree_.nodes.size() * sizeof(TreeNode) +
                                tree_.leaves.size() * sizeof(TreeLeaf));
  }

 private:
  const Scene& scene_;
  const Kernels& kernels_;
  Tree tree_;
  TreeView view_;
};

// The ray as the double-precision decisions of a query see it.
struct ExactRay {
  const Scene& scene;
  Vec3 origin, direction;  // direction of length 1
  double t_min, tie;
};

bool is_above_minimum(const RayQuery& query, int32_t patch) {
  const ExactRay& ray = *static_cast<const ExactRay*>(query.context);
  return exact_distance(ray.scene.triangle(patch), ray.origin, ray.direction) > ray.t_min;
}

// Sine of the angle between triangle and direction.
double tilt_of(const Triangle& triangle, Vec3 direction) {
  return std::fabs(dot(normalized(triangle.area_vector()), direction));
}

bool meets_front(const ExactRay& ray, int32_t patch) {
  return dot(ray.scene.triangle(patch).area_vector(), ray.direction) < 0;
}

bool is_nearer(const RayQuery& query, int32_t patch, int32_t than) {
  if (than < 0) return true;
  const ExactRay& ray = *static_cast<const ExactRay*>(query.context);
  const double t = exact_distance(ray.scene.triangle(patch), ray.origin, ray.direction);
  const double other = exact_distance(ray.scene.triangle(than), ray.origin, ray.direction);
  const double tilt = std::min(tilt_of(ray.scene.triangle(patch), ray.direction),
                               tilt_of(ray.scene.triangle(than), ray.direction));
  if (std::fabs(t - other) * tilt <= ray.tie) {
    // The two sides of a sheet: light meets the one that faces it.
    const bool front = meets_front(ray, patch);
    return front != meets_front(ray, than) ? front : patch < than;
  }
  return t < other;
}

Hit BuiltinEngine::nearest(Vec3 origin, Vec3 direction, double t_min) const {
  const double size = length(direction);
  if (!(size > 0) || !std::isfinite(size)) return {};
  const Vec3 unit = direction * (1 / size);
  const Vec3 from_center = origin - center_;
  // Single precision starts close to the scene, however far away the ray does.
  const double ahead = std::max(0.0, -dot(from_center, unit) - 1.5 * radius_);
  const Vec3 start = from_center + unit * ahead;
  const ExactRay exact{scene_, origin, unit, t_min * size, tie * radius_};
  RayQuery query;
  for (int axis = 0; axis < 3; ++axis) {
    query.origin[axis] = static_cast<float>(start[axis]);
    query.direction[axis] = static_cast<float>(unit[axis]);
  }
  query.t_min = static_cast<float>(std::max(t_min * size - ahead, -8 * radius_));
  query.band = static_cast<float>(single_precision * radius_);
  query.is_above_minimum = is_above_minimum;
  query.is_nearer = is_nearer;
  query.context = &exact;
  query.t = tree_nowhere;
  query.doubt = 0;
  query.patch = -1;
  kernels_.nearest(view_, query);
  if (query.patch < 0) return {};
  return exact_hit(scene_, query.patch, origin, direction,
                   (static_cast<double>(query.t) + ahead) / size);
}

}  // namespace

std::unique_ptr<VisibilityEngine> make_builtin_engine(const Scene& scene,
                                                      const std::string& instruction_set,
                                                      ThreadTeam& team) {
  return std::make_unique<BuiltinEngine>(scene, choose_kernels(instruction_set.c_str()), team);
}

}  // namespace hrad
