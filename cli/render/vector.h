// Vectors of three reals for pictures. CLI: public headers only.
#pragma once

#include <cmath>

namespace hrad::cli {

struct Vector3 {
  double x = 0, y = 0, z = 0;
};

inline Vector3 operator+(const Vector3& a, const Vector3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vector3 operator-(const Vector3& a, const Vector3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vector3 operator*(double s, const Vector3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Vector3& a, const Vector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vector3& a) { return std::sqrt(dot(a, a)); }
// A vector without length stays as it is.
inline Vector3 normalized(const Vector3& a) {
  const double size = length(a);
  return size > 0 ? (1 / size) * a : a;
}

// The axis 0, 1 or 2.
inline double& component(Vector3* a, int axis) {
  return axis == 0 ? a->x : axis == 1 ? a->y : a->z;
}
inline double component(const Vector3& a, int axis) {
  return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}
inline Vector3 axis_vector(int axis, double size = 1) {
  Vector3 result;
  component(&result, axis) = size;
  return result;
}

}  // namespace hrad::cli
