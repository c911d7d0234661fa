// Vectors, triangles and random numbers of the reference solutions. They share nothing with lib/,
// so that an error there can't hide here.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace physics {

constexpr double pi = 3.14159265358979323846;

struct Vector {
  double x = 0, y = 0, z = 0;
};

inline Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator*(Vector a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vector operator*(double s, Vector a) { return a * s; }
inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double length(Vector a) { return std::sqrt(dot(a, a)); }
inline Vector normalized(Vector a) { return a * (1 / length(a)); }
inline Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

using Polygon = std::vector<Vector>;  // anticlockwise seen from its front

// The parallelogram corner, corner + u, corner + u + v, corner + v; its front looks along u x v.
inline Polygon parallelogram(Vector corner, Vector u, Vector v) {
  return {corner, corner + u, corner + u + v, corner + v};
}

// Twice the area of a plane polygon, along its normal.
inline Vector doubled_area(const Polygon& polygon) {
  Vector sum;
  for (size_t i = 2; i < polygon.size(); ++i)
    sum = sum + cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return sum;
}
inline double area(const Polygon& polygon) { return 0.5 * length(doubled_area(polygon)); }
inline Vector normal(const Polygon& polygon) { return normalized(doubled_area(polygon)); }

// A stream of random numbers; streams of different seeds are independent for our purposes.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(mixed(seed + 0x632be59bd9b4e019u)) {}
  uint64_t bits() { return mixed(state_ += 0x9e3779b97f4a7c15u); }
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }  // [0, 1)

  static uint64_t mixed(uint64_t z) {  // the finalizer of splitmix64
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

 private:
  uint64_t state_;
};

}  // namespace physics
