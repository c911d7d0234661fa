// What a sound mesh is, told by brute force and apart from lib/: connected solids and their edges,
// overlaps of coplanar triangles, crossings.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace hrad_test {

using hrad::Box;
using hrad::Scene;
using hrad::Triangle;
using hrad::Vec3;

struct Component {
  std::vector<int64_t> patches;
  double volume = 0;  // signed; of any meaning only when closed
  bool closed = true;
  Box box;
  bool is_box() const {
    const Vec3 e = box.extent();
    return closed && std::fabs(volume - e.x * e.y * e.z) < 1e-9;
  }
};

// Patches joined by shared vertex numbers; closed when every edge is run along exactly once in each
// direction.
inline std::vector<Component> components(const Scene& scene) {
  std::vector<int32_t> root(scene.vertices.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const auto& c : scene.corners) {
    root[find(c[0])] = find(c[1]);
    root[find(c[1])] = find(c[2]);
  }
  std::vector<int32_t> number(scene.vertices.size(), -1);
  std::vector<Component> result;
  for (int64_t patch = 0; patch < scene.patch_count(); ++patch) {
    int32_t& n = number[find(scene.corners[patch][0])];
    if (n < 0) {
      n = static_cast<int32_t>(result.size());
      result.emplace_back();
    }
    result[n].patches.push_back(patch);
  }
  for (Component& component : result) {
    std::vector<std::pair<int32_t, int32_t>> edges, reversed;
    for (const int64_t patch : component.patches) {
      const auto& c = scene.corners[patch];
      for (int i = 0; i < 3; ++i) {
        edges.emplace_back(c[i], c[(i + 1) % 3]);
        reversed.emplace_back(c[(i + 1) % 3], c[i]);
      }
      const Triangle t = scene.triangle(patch);
      component.volume += dot(t.a, cross(t.b, t.c)) / 6;
      for (const Vec3 p : {t.a, t.b, t.c}) component.box.grow(p);
    }
    std::sort(edges.begin(), edges.end());
    std::sort(reversed.begin(), reversed.end());
    component.closed =
        edges == reversed && std::adjacent_find(edges.begin(), edges.end()) == edges.end();
  }
  return result;
}

// Calls pair(i, j), i and j patches whose boxes touch.
template <class Function>
void for_touching_pairs(const Scene& scene, Function pair) {
  constexpr double slack = 1e-7;
  const int64_t n = scene.patch_count();
  std::vector<Box> boxes(n);
  std::vector<int64_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  for (int64_t i = 0; i < n; ++i) {
    const Triangle t = scene.triangle(i);
    for (const Vec3 p : {t.a, t.b, t.c}) boxes[i].grow(p);
  }
  std::sort(order.begin(), order.end(), [&](int64_t i, int64_t j) {
    return std::make_pair(boxes[i].low.x, i) < std::make_pair(boxes[j].low.x, j);
  });
  for (int64_t a = 0; a < n; ++a) {
    const Box& p = boxes[order[a]];
    for (int64_t b = a + 1; b < n && boxes[order[b]].low.x <= p.high.x + slack; ++b) {
      const Box& q = boxes[order[b]];
      if (p.low.y > q.high.y + slack || q.low.y > p.high.y + slack) continue;
      if (p.low.z > q.high.z + slack || q.low.z > p.high.z + slack) continue;
      pair(order[a], order[b]);
    }
  }
}

// The area that two coplanar triangles share (Sutherland and Hodgman); 0 if they are not coplanar.
// same_facing: whether their fronts look the same way.
inline double shared_area(const Triangle& s, const Triangle& t, bool& same_facing) {
  const Vec3 n = normalized(s.area_vector()), m = normalized(t.area_vector());
  same_facing = dot(n, m) > 0;
  if (length(cross(n, m)) > 1e-9 || std::fabs(dot(t.a - s.a, n)) > 1e-9) return 0;
  std::vector<Vec3> polygon = {s.a, s.b, s.c};
  const Vec3 clip[3] = {t.a, t.b, t.c};
  for (int i = 0; i < 3; ++i) {
    const Vec3 inward = normalized(cross(m, clip[(i + 1) % 3] - clip[i]));
    std::vector<Vec3> kept;
    for (size_t k = 0; k < polygon.size(); ++k) {
      const Vec3 p = polygon[k], q = polygon[(k + 1) % polygon.size()];
      const double dp = dot(p - clip[i], inward), dq = dot(q - clip[i], inward);
      if (dp >= 0) kept.push_back(p);
      if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) kept.push_back(p + (q - p) * (dp / (dp - dq)));
    }
    polygon = std::move(kept);
  }
  Vec3 twice;
  for (size_t k = 2; k < polygon.size(); ++k)
    twice = twice + cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  return length(twice) / 2;
}

// Per solid, the area pressed against others.
inline std::vector<double> sealed_areas(const Scene& scene, const std::vector<Component>& solids) {
  std::vector<size_t> solid_of(scene.patch_count());
  for (size_t solid = 0; solid < solids.size(); ++solid)
    for (const int64_t patch : solids[solid].patches) solid_of[patch] = solid;
  std::vector<double> sealed(solids.size());
  for_touching_pairs(scene, [&](int64_t i, int64_t j) {
    bool same_facing = false;
    const double shared = shared_area(scene.triangle(i), scene.triangle(j), same_facing);
    sealed[solid_of[i]] += shared;
    sealed[solid_of[j]] += shared;
  });
  return sealed;
}

// Whether an edge of s passes through the inside of t from one side to the other.
inline bool pierces(const Triangle& s, const Triangle& t) {
  constexpr double near = 1e-9;
  const Vec3 corners[3] = {s.a, s.b, s.c};
  const Vec3 normal = t.area_vector(), n = normalized(normal);
  for (int i = 0; i < 3; ++i) {
    const Vec3 p = corners[i], q = corners[(i + 1) % 3];
    const double dp = dot(p - t.a, n), dq = dot(q - t.a, n);
    if (std::fabs(dp) < near || std::fabs(dq) < near || (dp > 0) == (dq > 0)) continue;
    const Vec3 x = p + (q - p) * (dp / (dp - dq));
    const double area = length(normal);
    const double u = dot(cross(t.c - t.b, x - t.b), n) / area;
    const double v = dot(cross(t.a - t.c, x - t.c), n) / area;
    if (u > 1e-7 && v > 1e-7 && u + v < 1 - 1e-7) return true;
  }
  return false;
}

}  // namespace hrad_test
