// Frames around normals of all directions, and the distribution of cosine directions in them.
#include <vector>

#include "base/frame.h"
#include "base/hash.h"
#include "support/check.h"

namespace {

using namespace hrad;

std::vector<Vec3> normals() {
  std::vector<Vec3> result = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (uint64_t k = 0; k < 2000; ++k) {
    const double z = 2 * unit_interval(mix(k, 1)) - 1;
    const Turn turn = turn_of(unit_interval(mix(k, 2)));
    const double radius = std::sqrt(1 - z * z);
    result.push_back({radius * turn.cosine, radius * turn.sine, z});
  }
  // Close to where a frame built on z alone would break down.
  for (double small : {1e-4, 1e-8, 1e-12, 1e-16, 1e-300})
    for (double sign : {1.0, -1.0})
      result.push_back({small, -small, sign * std::sqrt(1 - 2 * small * small)});
  return result;
}

void axes_are_orthonormal_and_right_handed() {
  for (const Vec3& n : normals()) {
    const Frame frame(n);
    CHECK_NEAR(length(frame.tangent), 1, 1e-14);
    CHECK_NEAR(length(frame.bitangent), 1, 1e-14);
    CHECK_NEAR(dot(frame.tangent, frame.bitangent), 0, 1e-14);
    CHECK_NEAR(dot(frame.tangent, n), 0, 1e-14);
    CHECK_NEAR(dot(frame.bitangent, n), 0, 1e-14);
    CHECK_NEAR(length(cross(frame.tangent, frame.bitangent) - n), 0, 1e-14);
  }
}

void directions_lie_over_the_surface() {
  uint64_t k = 0;
  for (const Vec3& n : normals()) {
    const Frame frame(n);
    const double u = unit_interval(mix(++k, 3)), v = unit_interval(mix(k, 4));
    const Vec3 d = frame.cosine_direction(u, v);
    CHECK_NEAR(length(d), 1, 1e-13);
    // u is the squared sine to the normal.
    CHECK_NEAR(dot(d, n), std::sqrt(1 - u), 1e-13);
  }
  const Vec3 n = normalized({1, 2, -3});
  CHECK_NEAR(length(Frame(n).cosine_direction(0, 0.3) - n), 0, 1e-14);
}

// Under the density cos/pi the mean of cos is 2/3, of cos^2 1/2, of a tangent squared 1/4, and
// equal solid-angle shares of the azimuth are met equally often.
void directions_follow_the_cosine() {
  const Frame frame(normalized({-0.3, 0.8, 0.1}));
  constexpr int rows = 512, columns = 512;
  double cosine = 0, square = 0, tangent = 0, tangent_square = 0, mixed = 0;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Vec3 d = frame.cosine_direction((row + 0.5) / rows, (column + 0.5) / columns);
      const double c = dot(d, frame.normal), t = dot(d, frame.tangent);
      cosine += c;
      square += c * c;
      tangent += t;
      tangent_square += t * t;
      mixed += t * dot(d, frame.bitangent);
    }
  const double count = static_cast<double>(rows) * columns;
  CHECK_NEAR(cosine / count, 2.0 / 3, 1e-4);
  CHECK_NEAR(square / count, 0.5, 1e-9);
  CHECK_NEAR(tangent / count, 0, 1e-9);
  CHECK_NEAR(tangent_square / count, 0.25, 1e-9);
  CHECK_NEAR(mixed / count, 0, 1e-9);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(axes_are_orthonormal_and_right_handed),
      HRAD_TEST(directions_lie_over_the_surface),
      HRAD_TEST(directions_follow_the_cosine),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
