// A surface drawn face by face on the integer grid and triangulated without T-junctions.
// Floor 3 (scene).
#include "scene/generate_polyhedron.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "base/error.h"

namespace hrad {
namespace {

using GridKey = std::array<int32_t, 3>;
GridKey key(GridPoint p) { return {p.x, p.y, p.z}; }

// Twice the polygon's area, projected along each axis (Newell).
std::array<int64_t, 3> area_vector(const Outline& outline) {
  std::array<int64_t, 3> sum{};
  for (size_t i = 0; i < outline.size(); ++i) {
    const GridPoint a = outline[i], b = outline[(i + 1) % outline.size()];
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      sum[axis] += int64_t{a[u]} * b[v] - int64_t{b[u]} * a[v];
    }
  }
  return sum;
}

struct Point2 {
  int64_t u, v;
};

// Twice the signed area of a triangle.
int64_t turn(Point2 a, Point2 b, Point2 c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

// The outline seen along its dominant axis, so that it runs anticlockwise.
std::vector<Point2> project(const Outline& outline) {
  const std::array<int64_t, 3> normal = area_vector(outline);
  int axis = 0;
  for (int other = 1; other < 3; ++other)
    if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(u, v);
  std::vector<Point2> projected;
  for (const GridPoint& p : outline) projected.push_back({p[u], p[v]});
  return projected;
}

// Whether the corner at `middle` of the remaining ring can be cut off: it is convex, and no other
// corner lies in the triangle or on its sides.
bool is_ear(const std::vector<Point2>& points, const std::vector<int>& ring, size_t middle) {
  const size_t n = ring.size();
  const int ia = ring[(middle + n - 1) % n], ib = ring[middle], ic = ring[(middle + 1) % n];
  const Point2 a = points[ia], b = points[ib], c = points[ic];
  if (turn(a, b, c) <= 0) return false;
  for (const int i : ring) {
    if (i == ia || i == ib || i == ic) continue;
    const Point2 p = points[i];
    if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
  }
  return true;
}

// Corners of a polyhedron by the axis-parallel line they lie on, to find those inside an edge.
class LineIndex {
 public:
  void add(GridPoint p) {
    for (int axis = 0; axis < 3; ++axis) lines_[line(p, axis)].insert(p[axis]);
  }
  // The outline with every corner that lies inside one of its axis-parallel edges.
  Outline with_corners_inside_edges(const Outline& outline) const {
    Outline full;
    for (size_t i = 0; i < outline.size(); ++i) {
      const GridPoint a = outline[i], b = outline[(i + 1) % outline.size()];
      full.push_back(a);
      const int axis = common_axis(a, b);
      if (axis < 0) continue;
      const std::set<int32_t>& on_line = lines_.at(line(a, axis));
      std::vector<int32_t> inside(on_line.upper_bound(std::min(a[axis], b[axis])),
                                  on_line.lower_bound(std::max(a[axis], b[axis])));
      if (a[axis] > b[axis]) std::reverse(inside.begin(), inside.end());
      for (const int32_t at : inside) {
        GridKey corner = key(a);
        corner[axis] = at;
        full.push_back({corner[0], corner[1], corner[2]});
      }
    }
    return full;
  }

 private:
  // The axis along which a and b differ, -1 if there is more than one.
  static int common_axis(GridPoint a, GridPoint b) {
    int found = -1;
    for (int axis = 0; axis < 3; ++axis) {
      if (a[axis] == b[axis]) continue;
      if (found >= 0) return -1;
      found = axis;
    }
    return found;
  }
  static GridKey line(GridPoint p, int axis) {
    return {axis, p[(axis + 1) % 3], p[(axis + 2) % 3]};
  }

  std::map<GridKey, std::set<int32_t>> lines_;
};

}  // namespace

Outline rectangle(int axis, int32_t at, GridPoint low, GridPoint high, bool positive) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  Outline outline;
  for (const auto& [pu, pv] : {std::pair{low[u], low[v]}, std::pair{high[u], low[v]},
                               std::pair{high[u], high[v]}, std::pair{low[u], high[v]}}) {
    GridKey corner{};
    corner[axis] = at;
    corner[u] = pu;
    corner[v] = pv;
    outline.push_back({corner[0], corner[1], corner[2]});
  }
  return facing(std::move(outline), axis, positive);
}

Outline facing(Outline outline, int axis, bool positive) {
  if ((area_vector(outline)[axis] > 0) != positive) std::reverse(outline.begin(), outline.end());
  return outline;
}

void Polyhedron::add_face(Outline outline, int32_t material) {
  faces_.push_back({std::move(outline), material});
}

void Polyhedron::add_to(Scene& scene) const {
  LineIndex lines;
  for (const Face& face : faces_)
    for (const GridPoint& p : face.outline) lines.add(p);
  std::map<GridKey, int32_t> vertex_of;
  const auto vertex = [&](GridPoint p) {
    const auto [found, is_new] = vertex_of.try_emplace(key(p), 0);
    if (is_new) found->second = scene.add_vertex(metres(p));
    return found->second;
  };
  for (const Face& face : faces_) {
    const Outline outline = lines.with_corners_inside_edges(face.outline);
    for (const auto& [a, b, c] : triangulate_outline(outline))
      scene.add_patch(vertex(outline[a]), vertex(outline[b]), vertex(outline[c]), face.material);
  }
}

Polyhedron extrusion(const Profile& profile, int axis, int32_t low, int32_t high,
                     const Place& place, int32_t material) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto outline_at = [&](int32_t at) {
    Outline outline;
    for (const auto& corner : profile) {
      GridKey p{};
      p[axis] = at;
      p[u] = corner[0];
      p[v] = corner[1];
      outline.push_back({p[0], p[1], p[2]});
    }
    return facing(std::move(outline), axis, true);
  };
  const auto placed = [&](Outline outline) {
    for (GridPoint& p : outline) p = place(p);
    return outline;
  };
  const Outline bottom = outline_at(low), top = outline_at(high);
  Polyhedron solid;
  solid.add_face(placed(facing(bottom, axis, false)), material);
  solid.add_face(placed(top), material);
  for (size_t i = 0; i < bottom.size(); ++i) {
    const size_t next = (i + 1) % bottom.size();
    solid.add_face(placed({bottom[i], bottom[next], top[next], top[i]}), material);
  }
  return solid;
}

std::vector<std::array<int, 3>> triangulate_outline(const Outline& outline) {
  const std::vector<Point2> points = project(outline);
  std::vector<int> ring(points.size());
  for (size_t i = 0; i < ring.size(); ++i) ring[i] = static_cast<int>(i);
  std::vector<std::array<int, 3>> triangles;
  while (ring.size() >= 3) {
    // Cutting off the ear with the shortest new edge first keeps slivers away.
    const size_t n = ring.size();
    size_t best = n;
    int64_t shortest = 0;
    for (size_t i = 0; i < n; ++i) {
      if (!is_ear(points, ring, i)) continue;
      const Point2 a = points[ring[(i + n - 1) % n]], c = points[ring[(i + 1) % n]];
      const int64_t squared = (c.u - a.u) * (c.u - a.u) + (c.v - a.v) * (c.v - a.v);
      if (best == n || squared < shortest) {
        best = i;
        shortest = squared;
      }
    }
    if (best == n) fail(Status::internal, "a face of a built-in scene is not a simple polygon");
    triangles.push_back({ring[(best + n - 1) % n], ring[best], ring[(best + 1) % n]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return triangles;
}

}  // namespace hrad
