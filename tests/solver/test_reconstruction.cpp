// Linear reconstruction on trees split by hand: fields that it must reproduce, edges on which both
// sides must agree, surfaces that must not mix.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "hierarchy/corner_index.h"
#include "solver/reconstruction.h"
#include "support/alone.h"
#include "support/workbench.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using namespace hrad_test;

// Surfaces whose leaves have the means of a field over space, which for linear ones are its values
// at the centroids.
struct Field {
  explicit Field(Scene s, int bands = 1)
      : scene(std::move(s)), state(scene), forest(state.forest), bands(bands), alone(state) {
    state.bands = bands;
  }

  void split_unevenly(int level, uint64_t seed) {
    split_where(forest, level, [&](const Node& node) {
      return node.level < 1 || mix(key_of(forest, node), seed) % 5 < 2;
    });
  }

  template <class F>
  void fill(F&& f) {
    leaves = forest.leaves();
    state.irradiance.resize(forest.nodes.size() * bands);
    for (NodeId leaf : leaves)
      for (int b = 0; b < bands; ++b)
        state.irradiance[static_cast<size_t>(leaf) * bands + b] =
            static_cast<float>(f(forest.triangle(forest.nodes[leaf]).centroid(), b));
    linear = reconstructed();
  }

  std::unique_ptr<Reconstruction> reconstructed() {
    ThreadTeam team(1);
    return std::make_unique<Reconstruction>(state, leaves, alone.exchange, team, 0);
  }

  // The value of surface `root` at its (u,v).
  double at(NodeId root, double u, double v, int band = 0) const {
    std::vector<double> out(bands);
    linear->at(forest.leaf_at(root, u, v), u, v, out.data());
    return out[band];
  }

  Scene scene;
  State state;
  Forest& forest;
  int bands;
  std::vector<NodeId> leaves;
  Alone alone;
  std::unique_ptr<Reconstruction> linear;
};

// A unit square of two triangles that share the diagonal from (0,0) to (1,1).
Scene square() {
  Scene scene;
  add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  return scene;
}

// (u,v) of the triangle of the square that holds (x,y).
NodeId place_in_square(double x, double y, double* u, double* v) {
  if (x >= y) {  // (0,0) (1,0) (1,1)
    *u = x - y;
    *v = y;
    return 0;
  }
  *u = x;  // (0,0) (1,1) (0,1)
  *v = y - x;
  return 1;
}

double at_point(const Field& field, double x, double y) {
  double u, v;
  const NodeId root = place_in_square(x, y, &u, &v);
  return field.at(root, u, v);
}

void constant_fields_are_reproduced() {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    Field field(square(), 2);
    field.split_unevenly(6, seed);
    field.fill([](Vec3, int band) { return band ? 0.25 : 3.5; });
    for (uint64_t k = 0; k < 500; ++k) {
      double u, v;
      const NodeId root =
          place_in_square(unit_interval(mix(k, 1)), unit_interval(mix(k, 2)), &u, &v);
      CHECK_NEAR(field.at(root, u, v, 0), 3.5, 1e-6);
      CHECK_NEAR(field.at(root, u, v, 1), 0.25, 1e-6);
    }
  }
}

double slope(Vec3 p, int) { return 1 + 2 * p.x + 0.5 * p.y; }

// Around an inner corner of an even mesh the leaves lie evenly: the field is met exactly, across
// the diagonal too. At the border it is flat over half an element.
void linear_fields_are_reproduced_inside_an_even_mesh() {
  for (int level : {2, 3, 5}) {
    Field field(square());
    split_all(field.forest, level);
    field.fill(slope);
    const double step = 1.0 / (1 << level);
    for (uint64_t k = 0; k < 2000; ++k) {
      const double x = unit_interval(mix(k, 1)), y = unit_interval(mix(k, 2));
      const bool inside = std::min(std::min(x, y), std::min(1 - x, 1 - y)) > step;
      CHECK_NEAR(at_point(field, x, y), slope({x, y, 0}, 0), inside ? 1e-5 : 2 * step);
    }
  }
}

// Of any mesh: values lie between those of the leaves, and near the field by the size of elements.
void linear_fields_are_met_closely_by_an_uneven_mesh() {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    Field field(square());
    split_all(field.forest, 3);
    field.split_unevenly(7, seed);
    field.fill(slope);
    double square_sum = 0, steps = 0;
    for (uint64_t k = 0; k < 1000; ++k) {
      const double x = unit_interval(mix(k, 1)), y = unit_interval(mix(k, 2));
      double u, v;
      const NodeId root = place_in_square(x, y, &u, &v);
      const double wanted = slope({x, y, 0}, 0), found = field.at(root, u, v);
      CHECK_NEAR(found, wanted, 2.5 / 8);
      CHECK(found >= 1 && found <= 3.5);
      square_sum += (found - wanted) * (found - wanted);
      const float mean = field.state.irradiance[field.forest.leaf_at(root, u, v)];
      steps += (mean - wanted) * (mean - wanted);
    }
    // Better than the means alone.
    CHECK(square_sum < 0.9 * steps);
  }
}

// Walks along every edge of every leaf and looks at both sides.
void no_cracks_open() {
  int hanging = 0;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    Field field(square());
    field.split_unevenly(6, seed);
    field.fill([](Vec3 p, int) {
      return unit_interval(mix(static_cast<uint64_t>(p.x * 1e6), static_cast<uint64_t>(p.y * 1e6)));
    });
    for (NodeId leaf : field.leaves) {
      const Triangle t = field.forest.triangle(field.forest.nodes[leaf]);
      const Vec3 corners[3] = {t.a, t.b, t.c};
      for (int k = 0; k < 3; ++k)
        for (uint64_t m = 0; m < 4; ++m) {
          const double s = 0.01 + 0.98 * unit_interval(mix(m, seed));
          const Vec3 p = corners[k] * (1 - s) + corners[(k + 1) % 3] * s;
          const Vec3 in = (t.centroid() - p) * 1e-7;
          const Vec3 here = p + in, there = p - in;
          if (there.x < 0 || there.y < 0 || there.x > 1 || there.y > 1) continue;
          CHECK_NEAR(at_point(field, here.x, here.y), at_point(field, there.x, there.y), 1e-4);
          double u, v;
          const NodeId other = place_in_square(there.x, there.y, &u, &v);
          const NodeId beside = field.forest.leaf_at(other, u, v);
          hanging += field.forest.nodes[beside].level != field.forest.nodes[leaf].level;
        }
    }
  }
  CHECK(hanging > 1000);
}

// What corners() says is what at() finds there.
void corners_are_the_ends_of_the_values() {
  Field field(square(), 3);
  field.split_unevenly(5, 3);
  field.fill([](Vec3 p, int band) { return 1 + p.x * (band + 1) + p.y * p.y; });
  for (NodeId leaf : field.leaves) {
    const Node& node = field.forest.nodes[leaf];
    double corner[9], value[3];
    field.linear->corners(leaf, corner);
    LatticePoint lattice[3];
    lattice_corners(node, lattice);
    for (int c = 0; c < 3; ++c) {
      const double size = 1 << max_level;
      field.linear->at(leaf, lattice[c].i / size, lattice[c].j / size, value);
      for (int b = 0; b < 3; ++b) CHECK_NEAR(value[b], corner[3 * c + b], 1e-12);
    }
  }
}

// The lattice's corners are the corners of the element.
void lattice_corners_are_those_of_the_element() {
  Field field(square());
  field.split_unevenly(6, 4);
  for (const Node& node : field.forest.nodes) {
    const Triangle t = field.forest.triangle(node), root = field.forest.root_triangle(node.surface);
    const Vec3 corners[3] = {t.a, t.b, t.c};
    LatticePoint lattice[3];
    lattice_corners(node, lattice);
    for (int c = 0; c < 3; ++c) {
      const double size = 1 << max_level;
      const Vec3 p = root.at(lattice[c].i / size, lattice[c].j / size);
      CHECK_NEAR(length(p - corners[c]), 0, 1e-12);
    }
  }
}

// Two squares that meet in an edge under a right angle, one bright, one dark.
void surfaces_at_an_angle_do_not_mix() {
  Scene scene = square();
  add_quad(scene, {0, 0, 0}, {0, 1, 0}, {0, 0, 1});
  Field field(std::move(scene));
  field.split_unevenly(4, 5);
  field.fill([](Vec3 p, int) { return p.z > 0 ? 0.0 : 1.0; });
  for (uint64_t k = 0; k < 500; ++k) {
    double u = unit_interval(mix(k, 1)), v = unit_interval(mix(k, 2));
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    for (NodeId root = 0; root < 4; ++root)
      CHECK_NEAR(field.at(root, u, v), root < 2 ? 1.0 : 0.0, 1e-6);
  }
}

// Nor do the two sides of a sheet, or squares in one plane that don't share an edge.
void sides_and_strangers_do_not_mix() {
  Scene sheet = square();
  for (uint8_t& flag : sheet.flags) flag |= patch_two_sided;
  add_quad(sheet, {5, 0, 0}, {1, 0, 0}, {0, 1, 0});
  Field field(std::move(sheet));
  split_all(field.forest, 3);
  field.leaves = field.forest.leaves();
  const auto value_of = [&](const Node& node) {
    const Surface& surface = field.forest.surfaces[node.surface];
    return surface.patch >= 2 ? 9.0f : surface.side ? 4.0f : 1.0f;
  };
  for (const Node& node : field.forest.nodes) field.state.irradiance.push_back(value_of(node));
  field.linear = field.reconstructed();
  for (NodeId root = 0; root < field.forest.surface_count(); ++root)
    for (double u : {0.0, 0.1, 0.5})
      for (double v : {0.0, 0.2, 0.5})
        CHECK_NEAR(field.at(root, u, v), value_of(field.forest.nodes[root]), 1e-6);
}

// Corners meet by position, not by the number of a vertex: triangles given apart are one surface.
void vertices_given_twice_are_one() {
  Scene apart;
  add_triangle(apart, {0, 0, 0}, {1, 0, 0}, {1, 1, 0});
  add_triangle(apart, {0, 0, 0}, {1, 1, 0}, {0, 1, 0});
  Field separate(std::move(apart)), joined(square());
  for (Field* field : {&separate, &joined}) {
    field->split_unevenly(4, 6);
    field->fill(slope);
  }
  for (uint64_t k = 0; k < 500; ++k) {
    const double x = unit_interval(mix(k, 1)), y = unit_interval(mix(k, 2));
    CHECK_EQUAL(at_point(separate, x, y), at_point(joined, x, y));
  }
}

// Sealed leaves weigh nothing: what meets a contact isn't darkened by it.
void sealed_leaves_do_not_darken_their_neighbours() {
  Field field(square());
  split_all(field.forest, 4);
  NodeArray& nodes = field.forest.nodes;
  for (size_t k = 0; k < nodes.size(); ++k)
    nodes.set_exposed(k, field.forest.triangle(nodes[k]).centroid().x < 0.5 ? 0.0f : 1.0f);
  field.fill([](Vec3 p, int) { return p.x < 0.5 ? 0.0 : 2.0; });
  for (uint64_t k = 0; k < 500; ++k) {
    const double x = unit_interval(mix(k, 1)), y = unit_interval(mix(k, 2));
    double u, v;
    const NodeId root = place_in_square(x, y, &u, &v);
    if (field.forest.nodes[field.forest.leaf_at(root, u, v)].exposed > 0)
      CHECK_NEAR(at_point(field, x, y), 2, 1e-6);
  }
}

// Along the border a slope goes on beyond the means of the elements, by half of the brightest at
// the most.
void values_are_never_negative() {
  Field field(square());
  field.split_unevenly(6, 7);
  field.fill([](Vec3 p, int) { return p.x > 0.7 ? 100.0 : 0.0; });
  for (uint64_t k = 0; k < 2000; ++k) {
    const double value = at_point(field, unit_interval(mix(k, 1)), unit_interval(mix(k, 2)));
    CHECK(value >= 0 && value <= 150);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(constant_fields_are_reproduced),
      HRAD_TEST(linear_fields_are_reproduced_inside_an_even_mesh),
      HRAD_TEST(linear_fields_are_met_closely_by_an_uneven_mesh),
      HRAD_TEST(no_cracks_open),
      HRAD_TEST(corners_are_the_ends_of_the_values),
      HRAD_TEST(lattice_corners_are_those_of_the_element),
      HRAD_TEST(surfaces_at_an_angle_do_not_mix),
      HRAD_TEST(sides_and_strangers_do_not_mix),
      HRAD_TEST(vertices_given_twice_are_one),
      HRAD_TEST(sealed_leaves_do_not_darken_their_neighbours),
      HRAD_TEST(values_are_never_negative),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
