// From the unit square to a triangle, so that even points stay even. Floor 1 (base).
#pragma once

#include <cmath>

namespace hrad {

// Folds the square along its diagonal: points of the far half come back into the near one.
inline void fold_into_triangle(double& u, double& v) {
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
}

// Without a fold: neighbours stay neighbours, as sets of evenly spread points want it.
inline void even_in_triangle(double a, double b, double* u, double* v) {
  const double from_first_corner = std::sqrt(a);
  *u = from_first_corner * (1 - b);
  *v = from_first_corner * b;
}

}  // namespace hrad
