// Angles without libm, whose transcendentals differ between processors: the same bits everywhere.
// Floor 1 (base).
#pragma once

namespace hrad {

constexpr double pi = 3.14159265358979323846;

// The angle in [0, pi] whose sine and cosine are in the proportion sine : cosine, sine >= 0; 0 for
// 0 : 0. Absolute error below 1e-12. The range is halved twice until |x| <= tan(pi/8), where
// the series of the arc tangent is cut after x^27. Number: double, or a vector of the compiler's,
// lane by lane with the same bits.
template <class Number>
inline Number angles_of(Number sine, Number cosine) {
  const Number zero{};
  const Number magnitude = cosine < 0 ? -cosine : cosine;
  const auto steep = sine > magnitude;
  const Number above = steep ? magnitude : sine;
  const Number below = steep ? sine : magnitude;
  // atan(above/below) in [0, pi/4]; above tan(pi/8) turned back by pi/4.
  const auto turned = above > 0.41421356237309503 * below;
  const Number numerator = turned ? above - below : above;
  const Number denominator = turned ? above + below : below;
  const Number x = denominator > 0 ? numerator / denominator : zero;
  const Number z = x * x;
  Number series = zero + 1.0 / 27;
  series = 1.0 / 25 - z * series;
  series = 1.0 / 23 - z * series;
  series = 1.0 / 21 - z * series;
  series = 1.0 / 19 - z * series;
  series = 1.0 / 17 - z * series;
  series = 1.0 / 15 - z * series;
  series = 1.0 / 13 - z * series;
  series = 1.0 / 11 - z * series;
  series = 1.0 / 9 - z * series;
  series = 1.0 / 7 - z * series;
  series = 1.0 / 5 - z * series;
  series = 1.0 / 3 - z * series;
  Number angle = x * (1 - z * series);
  angle = turned ? angle + pi / 4 : angle;
  angle = steep ? pi / 2 - angle : angle;
  return cosine < 0 ? pi - angle : angle;
}
inline double angle_of(double sine, double cosine) { return angles_of(sine, cosine); }

// Cosine and sine of a fraction in [0,1) of a full turn. Absolute error below 1e-13: the nearest
// quarter turn is taken away, the rest is at most pi/4, where the series are cut after x^14, x^15.
struct Turn {
  double cosine, sine;
};
inline Turn turn_of(double fraction) {
  const int quarter = static_cast<int>(fraction * 4 + 0.5);
  const double x = (fraction - 0.25 * quarter) * (2 * pi);
  const double z = x * x;
  const double c =
      1 - z / 2 * (1 - z / 12 * (1 - z / 30 * (1 - z / 56 * (1 - z / 90 * (1 - z / 132 *
      (1 - z / 182))))));
  const double s =
      x * (1 - z / 6 * (1 - z / 20 * (1 - z / 42 * (1 - z / 72 * (1 - z / 110 * (1 - z / 156 *
      (1 - z / 210)))))));
  switch (quarter & 3) {
    case 0: return {c, s};
    case 1: return {-s, c};
    case 2: return {-c, -s};
    default: return {s, -c};
  }
}

}  // namespace hrad
