// Points and directions in space. Floor 1 (base).
#pragma once

#include <algorithm>
#include <cmath>

namespace hrad {

struct Vec3 {
  double x = 0, y = 0, z = 0;
  double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(Vec3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec3 operator*(double s, Vec3 a) { return a * s; }
inline bool operator==(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
// The zero vector stays zero.
inline Vec3 normalized(Vec3 a) {
  const double l = length(a);
  return l > 0 ? a * (1 / l) : Vec3{};
}
inline Vec3 min(Vec3 a, Vec3 b) {
  return {a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z};
}
inline Vec3 max(Vec3 a, Vec3 b) {
  return {a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z};
}

// Corners in anticlockwise order seen from the front.
struct Triangle {
  Vec3 a, b, c;
  // Twice the area long, towards the front.
  Vec3 area_vector() const { return cross(b - a, c - a); }
  Vec3 centroid() const { return (a + b + c) * (1.0 / 3); }
  // Of the ball around the centroid.
  double radius() const {
    const Vec3 middle = centroid();
    return std::max({length(a - middle), length(b - middle), length(c - middle)});
  }
  Vec3 at(double u, double v) const { return a * (1 - u - v) + b * u + c * v; }
};

struct Box {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  void grow(Vec3 p) {
    low = min(low, p);
    high = max(high, p);
  }
  void grow(const Box& b) {
    low = min(low, b.low);
    high = max(high, b.high);
  }
  bool empty() const { return low.x > high.x; }
  Vec3 center() const { return (low + high) * 0.5; }
  Vec3 extent() const { return high - low; }
};

}  // namespace hrad
