// Fields on elements: means kept, slopes up to the border, no rings around what is odd.
#include <cmath>

#include "solver/linear_field.h"
#include "support/check.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using namespace hrad_test;

// A square of two patches, each divided so many times.
struct Square {
  explicit Square(int levels) {
    add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    forest = std::make_unique<Forest>(scene);
    for (NodeId id = 0; id < static_cast<NodeId>(forest->nodes.size()); ++id) {
      if (forest->nodes[id].level == levels) continue;
      const NodeId first = static_cast<NodeId>(forest->nodes.size());
      forest->nodes.resize(forest->nodes.size() + 4);
      forest->nodes.adopt(id, first);
    }
    leaves = forest->leaves();
  }
  // From the means of f over the leaves alone.
  template <class F>
  LinearField field(F&& mean_of, double weight = 1) const {
    const auto mean = [&](NodeId leaf, double* values) {
      *values = mean_of(forest->triangle(forest->nodes[leaf]).centroid());
      return 1.0;
    };
    const auto weighed = [&](NodeId leaf, double* values) { return weight * mean(leaf, values); };
    return LinearField(
        *forest, 1, leaves, LinearField::Known::over_elements,
        [&](NodeId leaf, int, double* values) { return mean(leaf, values); }, weighed);
  }
  double largest_error(const LinearField& field, double (*wanted)(Vec3)) const {
    double largest = 0;
    for (NodeId leaf : leaves) {
      double value[3];
      field.corners(leaf, value);
      const Triangle t = forest->triangle(forest->nodes[leaf]);
      const Vec3 corner[3] = {t.a, t.b, t.c};
      for (int c = 0; c < 3; ++c)
        largest = std::max(largest, std::fabs(value[c] - wanted(corner[c])));
    }
    return largest;
  }
  Scene scene;
  std::unique_ptr<Forest> forest;
  std::vector<NodeId> leaves;
};

double slope(Vec3 p) { return 1 + 2 * p.x + p.y; }

// The means of a linear field are its values at the centroids. Averaged at corners alone they lose
// the slope along the border.
void a_slope_comes_back_up_to_the_border() {
  const Square square(4);
  const double averaged = square.largest_error(square.field(slope, 0), slope);
  CHECK(averaged > 0.05);
  CHECK(square.largest_error(square.field(slope), slope) < 0.5 * averaged);
}

void a_constant_stays_as_it_is() {
  const Square square(3);
  const auto one = [](Vec3) { return 1.0; };
  CHECK(square.largest_error(square.field(one), one) < 1e-6);
}

// One bright leaf among dark ones: nothing below half of what is dark, nothing above one and a half
// times what is bright.
void no_rings_around_a_bright_leaf() {
  const Square square(4);
  const Vec3 odd =
      square.forest->triangle(square.forest->nodes[square.leaves[square.leaves.size() / 3]])
          .centroid();
  const LinearField field =
      square.field([&](Vec3 p) { return length(p - odd) < 1e-9 ? 100.0 : 1.0; });
  double low = 1e30, high = 0;
  for (NodeId leaf : square.leaves) {
    double value[3];
    field.corners(leaf, value);
    for (double v : value) {
      low = std::min(low, v);
      high = std::max(high, v);
    }
  }
  CHECK(low >= 0.499);
  CHECK(high > 10 && high <= 150);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(a_slope_comes_back_up_to_the_border),
      HRAD_TEST(a_constant_stays_as_it_is),
      HRAD_TEST(no_rings_around_a_bright_leaf),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
