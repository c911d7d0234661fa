// The scene as the Monte Carlo reference sees it: triangles with their optical properties, either
// set up by a test or copied out of a solver through the public interface.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "physics/vector.h"

namespace physics {

constexpr int max_bands = 4;

// One value per band; unused bands stay 0.
struct Spectrum {
  std::array<double, max_bands> value{};
  double& operator[](int band) { return value[band]; }
  double operator[](int band) const { return value[band]; }
};

inline Spectrum gray(double v) {
  Spectrum s;
  s.value.fill(v);
  return s;
}
inline Spectrum operator+(const Spectrum& a, const Spectrum& b) {
  Spectrum s;
  for (int k = 0; k < max_bands; ++k) s[k] = a[k] + b[k];
  return s;
}
inline Spectrum operator*(const Spectrum& a, const Spectrum& b) {
  Spectrum s;
  for (int k = 0; k < max_bands; ++k) s[k] = a[k] * b[k];
  return s;
}
inline Spectrum operator*(const Spectrum& a, double factor) { return a * gray(factor); }
inline double sum(const Spectrum& s) {
  double total = 0;
  for (double v : s.value) total += v;
  return total;
}
inline double largest(const Spectrum& s) {
  return *std::max_element(s.value.begin(), s.value.end());
}

struct Surface {
  Vector a, b, c;
  Vector normal;
  double area = 0;  // 0: dropped, takes no part
  Spectrum reflectance, emission;
  bool two_sided = false, blocker = false;
  // The triangle with the same corners and the opposite winding, which makes a sheet with this one.
  int64_t partner = -1;

  int sides() const { return blocker || area == 0 ? 0 : two_sided ? 2 : 1; }
  bool emits() const { return sides() > 0 && sum(emission) > 0; }
  Vector at(double u, double v) const { return a + (b - a) * u + (c - a) * v; }
};

inline Surface triangle(Vector a, Vector b, Vector c, Spectrum reflectance, Spectrum emission) {
  Surface s;
  s.a = a, s.b = b, s.c = c;
  const Vector doubled = cross(b - a, c - a);
  s.area = 0.5 * length(doubled);
  if (s.area > 0) s.normal = normalized(doubled);
  s.reflectance = reflectance, s.emission = emission;
  return s;
}

// Adds a polygon with its front along its normal, as a fan of triangles.
inline void add_polygon(std::vector<Surface>& surfaces, const Polygon& p, Spectrum reflectance,
                        Spectrum emission) {
  for (size_t i = 2; i < p.size(); ++i)
    surfaces.push_back(triangle(p[0], p[i - 1], p[i], reflectance, emission));
}

// Finds the sheets: pairs of triangles with the same corners and opposite windings.
inline void find_partners(std::vector<Surface>& surfaces) {
  using Key = std::array<double, 9>;
  const auto key = [](const Surface& s, bool reversed) {
    std::array<Vector, 3> p = {s.a, reversed ? s.c : s.b, reversed ? s.b : s.c};
    const auto less = [](Vector l, Vector r) {
      return l.x != r.x ? l.x < r.x : l.y != r.y ? l.y < r.y : l.z < r.z;
    };
    std::rotate(p.begin(), std::min_element(p.begin(), p.end(), less), p.end());
    return Key{p[0].x, p[0].y, p[0].z, p[1].x, p[1].y, p[1].z, p[2].x, p[2].y, p[2].z};
  };
  std::map<Key, int64_t> known;
  for (size_t i = 0; i < surfaces.size(); ++i) {
    if (surfaces[i].area == 0) continue;
    known[key(surfaces[i], false)] = static_cast<int64_t>(i);
    const auto other = known.find(key(surfaces[i], true));
    if (other == known.end()) continue;
    surfaces[i].partner = other->second;
    surfaces[other->second].partner = static_cast<int64_t>(i);
  }
}

}  // namespace physics
