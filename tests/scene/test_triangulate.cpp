// Cutting polygons: the triangles cover the polygon, once, with its orientation.
#include <cmath>

#include "base/hash.h"
#include "scene/triangulate.h"
#include "support/check.h"

using hrad::Vec3;

namespace {

constexpr double pi = 3.14159265358979323846;

using Polygon = std::vector<Vec3>;
using Triangles = std::vector<std::array<int32_t, 3>>;

Vec3 area_vector(const Polygon& p) {
  Vec3 sum;
  for (size_t i = 1; i + 1 < p.size(); ++i) sum = sum + cross(p[i] - p[0], p[i + 1] - p[0]);
  return sum;
}

// Even-odd rule in the xy plane.
bool inside(const Polygon& p, double x, double y) {
  bool in = false;
  for (size_t i = 0, j = p.size() - 1; i < p.size(); j = i++)
    if ((p[i].y > y) != (p[j].y > y) &&
        x < (p[j].x - p[i].x) * (y - p[i].y) / (p[j].y - p[i].y) + p[i].x)
      in = !in;
  return in;
}

// Every triangle has the polygon's orientation, their areas add up, and random points of the
// polygon's box lie in one triangle if they are in the polygon and in none otherwise.
void check_cover(const Polygon& p, const Triangles& triangles) {
  const Vec3 normal = area_vector(p);
  const double total = length(normal);
  double sum = 0;
  for (const auto& t : triangles) {
    const Vec3 a = cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
    CHECK(dot(a, normal) > 0);
    sum += length(a);
  }
  CHECK_NEAR(sum, total, 1e-9 * total);
  hrad::Box box;
  for (Vec3 v : p) box.grow(v);
  const Vec3 size = box.extent();
  if (size.z != 0) return;
  const int points = 20000 / static_cast<int>(p.size()) + 20;
  for (int i = 0; i < points; ++i) {
    const double x = box.low.x + size.x * hrad::unit_interval(hrad::mix(1, i));
    const double y = box.low.y + size.y * hrad::unit_interval(hrad::mix(2, i));
    int covers = 0;
    for (const auto& t : triangles) covers += inside({p[t[0]], p[t[1]], p[t[2]]}, x, y);
    CHECK_EQUAL(covers, inside(p, x, y) ? 1 : 0);
  }
}

Triangles cut(const Polygon& p, bool wanted = true) {
  Triangles triangles;
  CHECK_EQUAL(hrad::triangulate(p, triangles), wanted);
  return triangles;
}

// n - 2 triangles that cover the polygon, also when it runs the other way round and wherever it
// begins.
void check_polygon(Polygon p) {
  for (int direction = 0; direction < 2; ++direction) {
    for (size_t start : {size_t{0}, p.size() / 3}) {
      Polygon q(p.begin() + start, p.end());
      q.insert(q.end(), p.begin(), p.begin() + start);
      const Triangles triangles = cut(q);
      CHECK_EQUAL(triangles.size(), q.size() - 2);
      check_cover(q, triangles);
    }
    p = Polygon(p.rbegin(), p.rend());
  }
}

void convex_ones_become_fans() {
  for (int n : {3, 4, 5, 17}) {
    Polygon p;
    for (int i = 0; i < n; ++i)
      p.push_back({std::cos(2 * pi * i / n), std::sin(2 * pi * i / n), 0});
    const Triangles triangles = cut(p);
    CHECK_EQUAL(triangles.size(), static_cast<size_t>(n - 2));
    for (int i = 0; i < n - 2; ++i)
      CHECK((triangles[i] == std::array<int32_t, 3>{0, i + 1, i + 2}));
    check_polygon(p);
  }
}

void arrow() {
  // A fan is right around the inner corner and the one across, and leaves the polygon elsewhere.
  const Polygon p = {{0, 0, 0}, {2, -1, 0}, {0.5, 0, 0}, {2, 1, 0}};
  check_polygon(p);
  check_polygon({{2, 1, 0}, {0, 0, 0}, {2, -1, 0}, {0.5, 0, 0}});
  check_polygon({{2, -1, 0}, {0.5, 0, 0}, {2, 1, 0}, {0, 0, 0}});
}

void in_every_plane() {
  const Polygon flat = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {3, 3, 0},
                        {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  check_polygon(flat);
  const Vec3 axes[][2] = {{{0, 1, 0}, {0, 0, 1}},       {{0, 0, 1}, {1, 0, 0}},
                          {{0.6, 0.8, 0}, {0, 0, 1}},   {{1, 1, 1}, {1, -1, 0}},
                          {{-1, 2, 0.5}, {0.3, 0, -2}}, {{0, 0, -1}, {0, 1, 0}}};
  for (const auto& axis : axes) {
    Polygon p;
    for (Vec3 v : flat) p.push_back(Vec3{100, -200, 50} + v.x * axis[0] + v.y * axis[1]);
    check_polygon(p);
  }
}

void corners_on_a_line() {
  // Without triangles that have no area, which the fan would have.
  check_polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
  check_polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {0, 2, 0}, {0, 1, 0}});
  Polygon square;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < 9; ++i) {
      const double t = i / 9.0;
      square.push_back(side == 0   ? Vec3{t, 0, 0}
                       : side == 1 ? Vec3{1, t, 0}
                       : side == 2 ? Vec3{1 - t, 1, 0}
                                   : Vec3{0, 1 - t, 0});
    }
  check_polygon(square);
}

// Radii and directions at random around a centre.
Polygon star(uint64_t seed, int n) {
  Polygon p;
  for (int i = 0; i < n; ++i) {
    const double radius = 0.1 + hrad::unit_interval(hrad::mix(seed, i));
    p.push_back({radius * std::cos(2 * pi * i / n), radius * std::sin(2 * pi * i / n), 0});
  }
  return p;
}

void random_stars() {
  for (int i = 0; i < 200; ++i) check_polygon(star(i, 5 + i % 60));
}

Polygon comb(int teeth) {
  Polygon p = {{static_cast<double>(teeth), 0, 0}, {static_cast<double>(teeth), 1, 0}};
  for (int i = teeth; i-- > 0;) {
    p.push_back({i + 0.5, 9, 0});
    p.push_back({static_cast<double>(i), 1, 0});
  }
  p.push_back({0, 0, 0});
  return p;
}

Polygon spiral(int n) {
  Polygon p;
  for (int i = 0; i < n; ++i) {
    const double angle = 12 * pi * i / n, radius = 1 + angle;
    p.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  for (int i = n; i-- > 0;) {
    const double angle = 12 * pi * i / n, radius = 1.5 + angle;
    p.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  return p;
}

void combs_and_spirals() {
  check_polygon(comb(30));
  check_polygon(spiral(100));
}

void holes_joined_by_bridges() {
  // A frame: the bridge from corner to corner is run along twice.
  check_polygon({{0, 0, 0},
                 {4, 0, 0},
                 {4, 4, 0},
                 {0, 4, 0},
                 {0, 0, 0},
                 {1, 1, 0},
                 {1, 3, 0},
                 {3, 3, 0},
                 {3, 1, 0},
                 {1, 1, 0}});
  // Two holes from one corner.
  check_polygon({{0, 0, 0},
                 {9, 0, 0},
                 {9, 4, 0},
                 {0, 4, 0},
                 {0, 0, 0},
                 {1, 1, 0},
                 {1, 3, 0},
                 {3, 3, 0},
                 {3, 1, 0},
                 {1, 1, 0},
                 {0, 0, 0},
                 {5, 1, 0},
                 {5, 2, 0},
                 {6, 2, 0},
                 {6, 1, 0},
                 {5, 1, 0}});
  // A hole that touches the outline in a corner.
  check_polygon(
      {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}});
}

void large_ones() {
  for (const Polygon& p : {star(7, 50000), comb(50000), spiral(50000)}) {
    const Triangles triangles = cut(p);
    CHECK_EQUAL(triangles.size(), p.size() - 2);
    const Vec3 normal = area_vector(p);
    double sum = 0;
    for (const auto& t : triangles) {
      const Vec3 a = cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
      CHECK(a.z * normal.z > 0);
      sum += std::fabs(a.z);
    }
    CHECK_NEAR(sum, length(normal), 1e-9 * length(normal));
  }
}

void what_is_no_polygon_becomes_a_fan() {
  const Polygon bow_tie = {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 1, 0}};
  CHECK_EQUAL(cut(bow_tie, false).size(), size_t{2});
  const Polygon line = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  CHECK_EQUAL(cut(line, false).size(), size_t{2});
  const Polygon point(5, Vec3{1, 2, 3});
  CHECK_EQUAL(cut(point, false).size(), size_t{3});
  Polygon pentagram;
  for (int i = 0; i < 5; ++i)
    pentagram.push_back({std::cos(4 * pi * i / 5), std::sin(4 * pi * i / 5), 0});
  CHECK_EQUAL(cut(pentagram, false).size(), size_t{3});
}

void a_spike_has_no_triangle() {
  const Polygon p = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {4, 1, 0}, {2, 1, 0}, {2, 2, 0}, {0, 2, 0}};
  Triangles triangles;
  hrad::triangulate(p, triangles);
  double area = 0;
  for (const auto& t : triangles) area += cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]).z / 2;
  CHECK_NEAR(area, 4, 1e-12);
}

// Along the sides it overlaps them, and is what is left when all ears are cut off.
void a_spike_along_sides_has_no_triangle() {
  for (double tip : {6.0, 8.0}) {
    const Polygon p = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {4, tip, 0}, {4, 2, 0}, {0, 4, 0}};
    double area = 0;
    for (const auto& t : cut(p)) {
      const double twice = cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]).z;
      CHECK(twice > 0);
      area += twice / 2;
    }
    CHECK_NEAR(area, 12, 1e-12);
  }
}

void not_quite_flat() {
  Polygon p;
  for (Vec3 v : star(3, 40)) p.push_back({v.x, v.y, 0.01 * hrad::unit_interval(p.size() * 77)});
  const Triangles triangles = cut(p);
  CHECK_EQUAL(triangles.size(), size_t{38});
  for (const auto& t : triangles) CHECK(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]).z > 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(convex_ones_become_fans),
      HRAD_TEST(arrow),
      HRAD_TEST(in_every_plane),
      HRAD_TEST(corners_on_a_line),
      HRAD_TEST(random_stars),
      HRAD_TEST(combs_and_spirals),
      HRAD_TEST(holes_joined_by_bridges),
      HRAD_TEST(large_ones),
      HRAD_TEST(what_is_no_polygon_becomes_a_fan),
      HRAD_TEST(a_spike_has_no_triangle),
      HRAD_TEST(a_spike_along_sides_has_no_triangle),
      HRAD_TEST(not_quite_flat),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
