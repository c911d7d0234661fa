// The automatic camera (view_choice.h). CLI: public headers only.
#include "render/view_choice.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "render/glimpse.h"

namespace hrad::cli {
namespace {

constexpr double inside_fov = 60, outside_fov = 40;  // degrees

// A room is closed when from most places in it less than this share of all directions leaves it.
constexpr double most_open = 0.05;
// What a place in a room may have around it; others lie in a wall, in a desk or outside.
constexpr double most_black = 0.3, most_background = 0.4;

// Lamps that shine along an axis.
constexpr double along_axis = 0.8;

// Glimpses of all patches together: some seconds. Larger scenes get fewer glimpses.
constexpr int64_t most_patches_seen = 40'000'000;
constexpr size_t fewest_cameras = 12, fewest_places = 5;

// How many of `wanted` things can be tried that take so many glimpses each.
size_t affordable(const Geometry& geometry, int64_t glimpses, size_t fewest, size_t wanted) {
  const int64_t patches = std::max<int64_t>(1, glimpses * geometry.patches());
  return std::min(wanted, std::max(fewest, static_cast<size_t>(most_patches_seen / patches)));
}

// Shares of the way along the two level axes and the axis up.
class Box {
 public:
  Box(const Geometry& geometry, int up_axis)
      : lower_(geometry.lower), size_(geometry.upper - geometry.lower), up_(up_axis) {}
  Vector3 at(double first, double second, double height) const {
    Vector3 share;
    component(&share, (up_ + 1) % 3) = first;
    component(&share, (up_ + 2) % 3) = second;
    component(&share, up_) = height;
    return lower_ + Vector3{share.x * size_.x, share.y * size_.y, share.z * size_.z};
  }
  Vector3 up() const { return axis_vector(up_); }
  Vector3 level(int number) const { return axis_vector((up_ + 1 + number) % 3); }

 private:
  Vector3 lower_, size_;
  int up_;
};

// From corners and walls to the opposite side, then from places within to all sides.
std::vector<Camera> cameras_inside(const Box& box, double fov) {
  std::vector<Camera> cameras;
  const auto add = [&](double x, double y, double height, double look_x, double look_y) {
    cameras.push_back({box.at(x, y, height), box.at(look_x, look_y, 0.36), box.up(), fov});
  };
  for (double height : {0.62, 0.8})
    for (double x : {0.04, 0.96})
      for (double y : {0.04, 0.96}) add(x, y, height, 0.5 + (0.5 - x) * 0.3, 0.5 + (0.5 - y) * 0.3);
  for (double side : {0.03, 0.97}) {
    add(side, 0.5, 0.6, 1 - side, 0.5);
    add(0.5, side, 0.6, 0.5, 1 - side);
  }
  for (double x : {0.2, 0.4, 0.6, 0.8})
    for (double y : {0.2, 0.4, 0.6, 0.8})
      for (double way : {-0.4, 0.4}) {
        add(x, y, 0.6, x + way, y + 0.1);
        add(x, y, 0.6, x + 0.1, y + way);
      }
  return cameras;
}

// So far away along a direction that the whole box is in the picture.
Camera camera_outside(const Geometry& geometry, const Box& box, const Vector3& towards_eye,
                      const PictureSize& size, double fov) {
  const Vector3 ahead = -1.0 * normalized(towards_eye);
  const Vector3 right = normalized(cross(ahead, box.up())), down = cross(ahead, right);
  constexpr double used = 0.96;  // of the picture
  const double half_height = used * half_height_at_one(fov);
  const double half_width = half_height * size.width / size.height;
  double distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 p = box.at(corner & 1, corner >> 1 & 1, corner >> 2) - geometry.centre();
    const double needed =
        std::max(std::fabs(dot(p, right)) / half_width, std::fabs(dot(p, down)) / half_height);
    distance = std::max(distance, needed - dot(p, ahead));
  }
  return {geometry.centre() - distance * ahead, geometry.centre(), box.up(), fov};
}

std::vector<Camera> cameras_outside(const Geometry& geometry, const Box& box,
                                    const PictureSize& size, double fov) {
  std::vector<Camera> cameras;
  const auto add = [&](double x, double y, double height) {
    const Vector3 towards_eye = x * box.level(0) + y * box.level(1) + height * box.up();
    cameras.push_back(camera_outside(geometry, box, towards_eye, size, fov));
  };
  for (double way : {-1.0, 1.0}) {
    add(way, 0, 0);
    add(0, way, 0);
  }
  for (double x : {-0.8, 0.8})
    for (double y : {-1.0, 1.0})
      for (double height : {0.2, 0.6}) {
        add(x, y, height);
        add(y, x, height);
      }
  return cameras;
}

using Judgement = double (*)(const Glimpse& glimpse, double share_of_most_distinct);

double judge_inside(const Glimpse& glimpse, double distinct) {
  return distinct + std::min(0.5, glimpse.depth) - 4 * glimpse.black - 3 * glimpse.near -
         glimpse.background;
}

double judge_outside(const Glimpse& glimpse, double distinct) {
  return distinct - 3 * glimpse.black - glimpse.background;
}

Camera best_of(const Geometry& geometry, const std::vector<Camera>& cameras,
               const PictureSize& size, Judgement judge) {
  std::vector<Glimpse> glimpses;
  int most_distinct = 1;
  for (const Camera& camera : cameras) {
    glimpses.push_back(take_glimpse(geometry, camera, size));
    most_distinct = std::max(most_distinct, glimpses.back().distinct);
  }
  size_t best = 0;
  double best_score = -std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < cameras.size(); ++k) {
    const double score =
        judge(glimpses[k], static_cast<double>(glimpses[k].distinct) / most_distinct);
    if (score <= best_score) continue;
    best_score = score;
    best = k;
  }
  return cameras[best];
}

// Places where a viewer might stand: the middle first.
std::vector<Vector3> places_inside(const Box& box) {
  std::vector<Vector3> places;
  for (double height : {0.55, 0.25})
    for (double x : {0.5, 0.25, 0.75})
      for (double y : {0.5, 0.25, 0.75}) places.push_back(box.at(x, y, height));
  return places;
}

bool is_closed_room(const Geometry& geometry, const Box& box) {
  std::vector<double> open;  // per place in the room
  std::vector<Vector3> places = places_inside(box);
  places.resize(affordable(geometry, 6, fewest_places, places.size()));
  for (const Vector3& place : places) {
    const Surroundings around = look_around(geometry, place);
    if (around.black <= most_black && around.background <= most_background)
      open.push_back(around.background);
  }
  if (open.empty()) return false;
  const auto middle = open.begin() + static_cast<std::ptrdiff_t>(open.size() / 2);
  std::nth_element(open.begin(), middle, open.end());
  return *middle < most_open;
}

}  // namespace

int find_up_axis(const Geometry& geometry, int32_t known) {
  constexpr int y = 1, z = 2;
  if (known > 0) return known;
  const Vector3 size = geometry.upper - geometry.lower;
  if (size.z > std::min(size.x, size.y)) return y;
  double power_along_z = 0, power = 0;
  for (int64_t patch = 0; patch < geometry.patches(); ++patch) {
    if (geometry.has(patch, Geometry::dropped)) continue;
    const auto& corners = geometry.corners[static_cast<size_t>(patch)];
    const Vector3 twice_area = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double emission = geometry.emission[static_cast<size_t>(patch)];
    power += emission * length(twice_area);
    power_along_z += emission * std::fabs(twice_area.z);
  }
  return power_along_z > along_axis * power ? z : y;
}

Camera choose_camera(const Geometry& geometry, const PictureSize& size, int up_axis,
                     std::optional<double> fov) {
  const Box box(geometry, up_axis);
  const bool inside = is_closed_room(geometry, box);
  std::vector<Camera> cameras =
      inside ? cameras_inside(box, fov.value_or(inside_fov))
             : cameras_outside(geometry, box, size, fov.value_or(outside_fov));
  cameras.resize(affordable(geometry, 1, fewest_cameras, cameras.size()));
  return best_of(geometry, cameras, size, inside ? judge_inside : judge_outside);
}

}  // namespace hrad::cli
