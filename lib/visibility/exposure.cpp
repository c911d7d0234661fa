// Finding what may seal a patch once, and testing points against it. Floor 4 (visibility).
#include "visibility/exposure.h"

#include <algorithm>

#include "base/hash.h"
#include "visibility/box_tree.h"
#include "visibility/crossing.h"

namespace hrad {
namespace {

// Parallel surfaces closer than this share of the scene's radius are at the same height.
constexpr double same_height = 1e-9;
// Surfaces closer than this share of the scene's radius are pressed against each other.
constexpr double contact_distance = 1e-6;

Box grown(Box box, double by) {
  const Vec3 margin{by, by, by};
  return {box.low - margin, box.high + margin};
}

Box box_of(const Triangle& t) {
  Box box;
  box.grow(t.a);
  box.grow(t.b);
  box.grow(t.c);
  return box;
}

// Strictly inside.
bool holds(const Box& box, Vec3 p) {
  return p.x > box.low.x && p.x < box.high.x && p.y > box.low.y && p.y < box.high.y &&
         p.z > box.low.z && p.z < box.high.z;
}

bool same_corners(const Triangle& a, const Triangle& b) {
  const auto among = [&](Vec3 p) {
    for (Vec3 q : {b.a, b.b, b.c})
      if (p == q) return true;
    return false;
  };
  return among(a.a) && among(a.b) && among(a.c);
}

// Two triangles in about one plane have more in common than an edge: none of their edges separates
// them, by at least -margin.
bool overlap(const Triangle& s, const Triangle& t, Vec3 normal, double margin) {
  const auto separated_by_edge_of = [&](const Triangle& a, const Triangle& b) {
    const Vec3 corners[3] = {a.a, a.b, a.c};
    // Inward, whichever way round the triangle runs.
    const double way = dot(a.area_vector(), normal) > 0 ? 1 : -1;
    for (int k = 0; k < 3; ++k) {
      const Vec3 from = corners[k];
      const Vec3 inward = normalized(cross(normal, corners[(k + 1) % 3] - from)) * way;
      if (std::max({dot(b.a - from, inward), dot(b.b - from, inward), dot(b.c - from, inward)}) <=
          margin)
        return true;
    }
    return false;
  };
  return !separated_by_edge_of(s, t) && !separated_by_edge_of(t, s);
}

// Area of what two triangles of about one plane have in common: s, cut by the edges of t
// (Sutherland, Hodgman, "Reentrant polygon clipping", CACM 1974).
double common_area(const Triangle& s, const Triangle& t, Vec3 normal) {
  // Three edges make six corners of three; rounding may make a few more.
  Vec3 polygon[24] = {s.a, s.b, s.c}, cut[24];
  int count = 3;
  const Vec3 corners[3] = {t.a, t.b, t.c};
  const double way = dot(t.area_vector(), normal) > 0 ? 1 : -1;
  for (int edge = 0; edge < 3 && count > 0; ++edge) {
    const Vec3 from = corners[edge];
    const Vec3 inward = cross(normal, corners[(edge + 1) % 3] - from) * way;
    int kept = 0;
    for (int k = 0; k < count; ++k) {
      const Vec3 p = polygon[k], q = polygon[(k + 1) % count];
      const double at_p = dot(p - from, inward), at_q = dot(q - from, inward);
      if (at_p >= 0) cut[kept++] = p;
      if ((at_p >= 0) != (at_q >= 0)) cut[kept++] = p + (q - p) * (at_p / (at_p - at_q));
    }
    count = kept;
    std::copy(cut, cut + count, polygon);
  }
  double twice = 0;
  for (int k = 2; k < count; ++k)
    twice += length(cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]));
  return twice / 2;
}

// Of two parallel surfaces that are pressed together, which lies on the other: the higher one, seen
// from the side in question. Without a difference a sheet with two fronts lies on a surface with
// one, a lamp on what is dark, and otherwise the first of the two is seen, as with duplicates.
bool lies_on(const Scene& scene, int64_t q, int64_t p, double height, double tie) {
  if (std::fabs(height) > tie) return height > 0;
  const bool q_sheet = scene.has(q, patch_two_sided), p_sheet = scene.has(p, patch_two_sided);
  if (q_sheet != p_sheet) return q_sheet;
  const bool q_emits = scene.emits(q), p_emits = scene.emits(p);
  if (q_emits != p_emits) return q_emits;
  return q < p;
}

// The point lies over the triangle, seen along its normal.
bool over(const Triangle& t, Vec3 p) {
  const Vec3 normal = t.area_vector();
  return dot(cross(t.b - t.a, p - t.a), normal) >= 0 &&
         dot(cross(t.c - t.b, p - t.b), normal) >= 0 && dot(cross(t.a - t.c, p - t.c), normal) >= 0;
}

// What rays from a triangle start on, less a rim in which it may touch what it stands on or
// against.
Triangle lifted_inner(const Triangle& t, Vec3 normal, double offset) {
  const Vec3 center = t.centroid();
  const auto inner = [&](Vec3 corner) {
    const double reach = length(corner - center);
    const double rim = reach > 0 ? std::min(0.5, 4 * offset / reach) : 0;
    return corner + (center - corner) * rim + normal * offset;
  };
  return {inner(t.a), inner(t.b), inner(t.c)};
}

// A cosine direction for enclosed: any spread of directions serves.
Vec3 slanted(Vec3 normal, uint64_t hash) {
  const Vec3 noise{unit_interval(mix(hash, 1)) - 0.5, unit_interval(mix(hash, 2)) - 0.5,
                   unit_interval(mix(hash, 3)) - 0.5};
  return normalized(normal + noise * 0.9);
}

}  // namespace

Exposure::Exposure(const Scene& scene, const VisibilityEngine& engine)
    : scene_(scene), engine_(engine), solids_(find_solids(scene)) {
  const int64_t patches = scene.patch_count();
  const double contact = contact_distance * engine.radius();
  const double tie = same_height * engine.radius();
  std::vector<Box> boxes(patches);
  for (int64_t p = 0; p < patches; ++p)
    if (!scene.has(p, patch_dropped)) boxes[p] = box_of(scene.triangle(p));
  const BoxTree patch_tree(boxes);
  std::vector<Box> solid_boxes = solids_.box;
  for (size_t k = 0; k < solid_boxes.size(); ++k)
    if (!solids_.closed[k] || solids_.volume[k] <= 0) solid_boxes[k] = Box{};
  const BoxTree solid_tree(solid_boxes);

  first_cover_.push_back(0);
  first_enclosing_.push_back(0);
  for (int64_t p = 0; p < patches; ++p) {
    const Triangle triangle = scene.triangle(p);
    const Vec3 front = normalized(triangle.area_vector());
    for (int32_t side = 0; side < 2; ++side) {
      const bool exchanges = !scene.has(p, patch_dropped) && !scene.has(p, patch_blocker) &&
                             (side == 0 || scene.has(p, patch_two_sided));
      if (exchanges) {
        const Vec3 normal = side ? -front : front;
        const Box reach = grown(boxes[p], contact);
        const auto cover_begin = static_cast<std::ptrdiff_t>(covers_.size());
        patch_tree.overlapping(reach, [&](int32_t q) {
          if (q == p) return;
          const Triangle other = scene.triangle(q);
          const Vec3 other_normal = normalized(other.area_vector());
          const double facing = dot(other_normal, normal);
          if (std::fabs(facing) < 0.999999) return;
          if (same_corners(triangle, other)) return;  // a sheet, not a contact
          double height = 0;
          for (Vec3 corner : {other.a, other.b, other.c}) {
            const double h = dot(corner - triangle.a, normal);
            if (std::fabs(h) > contact) return;
            height += h / 3;
          }
          // A cover turns its front against this side, or lies on it as a rug on a floor.
          if ((facing < 0 || lies_on(scene, q, p, height, tie)) &&
              overlap(triangle, other, normal, contact))
            covers_.push_back(q);
        });
        std::sort(covers_.begin() + cover_begin, covers_.end());
        for (size_t c = cover_boxes_.size(); c < covers_.size(); ++c)
          cover_boxes_.push_back(grown(boxes[covers_[c]], 4 * contact));
        const auto solid_begin = static_cast<std::ptrdiff_t>(enclosing_.size());
        const Triangle lifted = lifted_inner(triangle, normal, engine.offset());
        std::vector<int32_t> crossed;  // solids whose surface this side passes through
        patch_tree.overlapping(box_of(lifted), [&](int32_t q) {
          if (triangles_cross(lifted, scene.triangle(q))) crossed.push_back(solids_.component[q]);
        });
        solid_tree.overlapping(box_of(lifted), [&](int32_t solid) {
          if (solid == solids_.component[p]) return;
          // The others enclose it whole or not at all.
          if (std::find(crossed.begin(), crossed.end(), solid) != crossed.end() ||
              enclosed(lifted.centroid(), normal))
            enclosing_.push_back(solid);
        });
        std::sort(enclosing_.begin() + solid_begin, enclosing_.end());
      }
      first_cover_.push_back(static_cast<int64_t>(covers_.size()));
      first_enclosing_.push_back(static_cast<int64_t>(enclosing_.size()));
    }
  }
}

Exposure::~Exposure() = default;

bool Exposure::can_be_sealed(int64_t patch, int32_t side) const {
  const int64_t k = 2 * patch + side;
  return first_cover_[k] < first_cover_[k + 1] || first_enclosing_[k] < first_enclosing_[k + 1];
}

Vec3 Exposure::normal_of(int64_t patch, int32_t side) const {
  const Vec3 front = normalized(scene_.triangle(patch).area_vector());
  return side ? -front : front;
}

bool Exposure::covered(int64_t cover, Vec3 point) const {
  return holds(cover_boxes_[cover], point) && over(scene_.triangle(covers_[cover]), point);
}

bool Exposure::pressed(int64_t patch, int32_t side, Vec3 point) const {
  const int64_t k = 2 * patch + side;
  for (int64_t c = first_cover_[k]; c < first_cover_[k + 1]; ++c)
    if (covered(c, point)) return true;
  return false;
}

bool Exposure::overlaid(int64_t patch, int32_t side, Vec3 point) const {
  const int64_t k = 2 * patch + side;
  const Vec3 normal = scene_.triangle(patch).area_vector() * (side ? -1.0 : 1.0);
  for (int64_t c = first_cover_[k]; c < first_cover_[k + 1]; ++c) {
    const Triangle cover = scene_.triangle(covers_[c]);
    const bool same_way =
        scene_.has(covers_[c], patch_two_sided) || dot(cover.area_vector(), normal) > 0;
    if (same_way && over(cover, point)) return true;
  }
  return false;
}

bool Exposure::inside_solid(int64_t patch, int32_t side, Vec3 point) const {
  const int64_t k = 2 * patch + side;
  const Vec3 normal = normal_of(patch, side);
  const Vec3 origin = point + normal * engine_.offset();
  for (int64_t c = first_enclosing_[k]; c < first_enclosing_[k + 1]; ++c)
    if (holds(solids_.box[enclosing_[c]], origin)) return enclosed(origin, normal);
  return false;
}

// The nearest surface shows its back, and it bounds a solid. Most of three rays, so that one that
// slips through an edge decides nothing.
bool Exposure::enclosed(Vec3 origin, Vec3 normal) const {
  int inside = 0, outside = 0;
  for (uint64_t ray = 0; inside < 2 && outside < 2; ++ray) {
    const Hit hit = engine_.nearest(origin, slanted(normal, mix(ray, 0x736f6c69u)), 0);
    const int32_t solid = hit.patch >= 0 && hit.back ? solids_.component[hit.patch] : -1;
    const bool in = solid >= 0 && solids_.closed[solid] && solids_.volume[solid] > 0;
    ++(in ? inside : outside);
  }
  return inside == 2;
}

bool Exposure::sealed(int64_t patch, int32_t side, Vec3 point) const {
  return can_be_sealed(patch, side) &&
         (pressed(patch, side, point) || inside_solid(patch, side, point));
}

Exposure::Part::Part(const Exposure& exposure, int64_t patch, int32_t side, const Triangle& corners)
    : exposure_(&exposure), corners_(corners), normal_(exposure.normal_of(patch, side)) {
  const int64_t k = 2 * patch + side;
  const double offset = exposure.engine_.offset();
  const Box on = box_of(corners), above = grown(on, offset);
  for (int64_t c = exposure.first_cover_[k]; c < exposure.first_cover_[k + 1]; ++c)
    if (overlap(exposure.cover_boxes_[c], on)) {
      const Triangle t = exposure.scene_.triangle(exposure.covers_[c]);
      covers_.push_back(
          {exposure.cover_boxes_[c], t, t.b - t.a, t.c - t.b, t.a - t.c, t.area_vector()});
    }
  for (int64_t c = exposure.first_enclosing_[k]; c < exposure.first_enclosing_[k + 1]; ++c) {
    const Box& box = exposure.solids_.box[exposure.enclosing_[c]];
    if (overlap(box, above)) solids_.push_back(box);
  }
}

double Exposure::Part::pressed_share() const {
  double area = 0;
  for (const Cover& cover : covers_) area += common_area(corners_, cover.corners, normal_);
  const double all = length(corners_.area_vector()) / 2;
  return all > 0 ? std::min(1.0, area / all) : 0;
}

bool Exposure::Part::Cover::over(Vec3 p) const {
  return holds(box, p) && dot(cross(ab, p - corners.a), normal) >= 0 &&
         dot(cross(bc, p - corners.b), normal) >= 0 && dot(cross(ca, p - corners.c), normal) >= 0;
}

bool Exposure::Part::sealed(Vec3 point) {
  if (last_ < covers_.size() && covers_[last_].over(point)) return true;
  for (size_t k = 0; k < covers_.size(); ++k)
    if (covers_[k].over(point)) {
      last_ = k;
      return true;
    }
  const Vec3 origin = point + normal_ * exposure_->engine_.offset();
  for (const Box& box : solids_)
    if (holds(box, origin)) return exposure_->enclosed(origin, normal_);
  return false;
}

}  // namespace hrad
