// Nearest hits against brute force in double precision, on every instruction set and on Embree.
#include "base/error.h"
#include "support/check.h"
#include "visibility/brute_force.h"

using namespace hrad;
using namespace hrad_test;

static std::vector<std::unique_ptr<VisibilityEngine>> all_sets(const Scene& scene,
                                                               ThreadTeam& team) {
  std::vector<std::unique_ptr<VisibilityEngine>> engines;
  for (const char* set : {"sse2", "avx2", "avx512"}) {
    try {
      engines.push_back(make_visibility_engine(scene, "builtin", set, team));
    } catch (const Error& e) {
      CHECK(e.status() == Status::argument);
    }
  }
  return engines;
}

static bool same(const Hit& a, const Hit& b) {
  return a.patch == b.patch && a.t == b.t && a.back == b.back && a.u == b.u && a.v == b.v;
}

// Returns false where the brute-force loop has doubts.
static bool compare(const Scene& scene,
                    const std::vector<std::unique_ptr<VisibilityEngine>>& engines, Vec3 origin,
                    Vec3 direction) {
  const Hit hit = engines[0]->nearest(origin, direction, 0);
  for (const auto& engine : engines) CHECK(same(engine->nearest(origin, direction, 0), hit));
  const double radius = engines[0]->radius(), far = 1e3 * radius / length(direction);
  const double doubt = 1e-6 * radius;
  double best = 1e300;
  bool doubtful = false;
  for (int64_t p = 0; p < scene.patch_count(); ++p) {
    const Crossing c = cross_triangle(scene.triangle(p), origin, direction * far, doubt);
    doubtful = doubtful || c.doubtful;
    if (c.clear) best = std::min(best, c.t * far);
  }
  if (doubtful) return false;
  CHECK_EQUAL(hit.patch >= 0, best < 1e300);
  if (hit.patch < 0) return true;
  CHECK_NEAR(hit.t * length(direction), best * length(direction), 1e-11 * radius);
  const Triangle triangle = scene.triangle(hit.patch);
  CHECK_EQUAL(hit.back, dot(triangle.area_vector(), direction) > 0);
  CHECK(hit.u >= 0 && hit.v >= 0 && hit.u + hit.v <= 1 + 1e-15);
  CHECK_NEAR(length(triangle.at(hit.u, hit.v) - (origin + direction * hit.t)), 0, 1e-9 * radius);
  return true;
}

static void soups() {
  ThreadTeam team(1);
  int64_t rays = 0, doubtful = 0, hits = 0;
  for (int64_t triangles : {1, 3, 8, 9, 60, 500, 3000}) {
    const Scene scene = random_soup(triangles, triangles > 100 ? 0.2 : 0.8, 77 + triangles);
    const auto engines = all_sets(scene, team);
    Random random(triangles);
    for (int i = 0; i < 1500; ++i) {
      const Vec3 origin = random.in_cube(i % 3 == 0 ? 50 : 1.5);
      const Vec3 direction = (random.in_cube(1) - origin) * random.between(0.01, 9);
      ++rays;
      doubtful += !compare(scene, engines, origin, direction);
      hits += engines[0]->nearest(origin, direction, 0).patch >= 0;
    }
  }
  CHECK(doubtful < rays / 50);
  CHECK(hits > rays / 4);
  CHECK(hits < rays);
}

static void room() {
  ThreadTeam team(1);
  const Scene scene = room_with_boxes(80, 15);
  const auto engines = all_sets(scene, team);
  Random random(8);
  int64_t doubtful = 0;
  for (int i = 0; i < 6000; ++i) {
    const Vec3 origin{random.between(0.01, 11.9), random.between(0.01, 8.9),
                      random.between(0.01, 2.9)};
    Vec3 direction = random.in_cube(1);
    if (i % 4 == 0) direction = {0, 0, i % 8 ? 1.0 : -1.0};
    if (i % 4 == 1) direction.x = 0;
    doubtful += !compare(scene, engines, origin, direction);
    CHECK(engines[0]->nearest(origin, direction, 0).patch >= 0);  // nothing leaves the room
  }
  CHECK(doubtful < 120);
}

// Of coincident triangles the first of those that face the ray, whatever the order of their corners.
static void ties() {
  ThreadTeam team(1);
  for (int64_t filler : {0, 3, 40}) {
    Scene scene;
    for (int64_t i = 0; i < filler; ++i)
      add_triangle(scene, {9.0 + i, 0, 0}, {9.5 + i, 0, 0}, {9.0 + i, 1, 0});
    const int64_t first = scene.patch_count();
    const Vec3 a{0.1, 0.2, 0.3}, b{1.1, 0.3, 0.7}, c{0.4, 1.7, -0.2};
    add_triangle(scene, b, c, a);
    add_triangle(scene, a, b, c);
    add_triangle(scene, a, c, b);
    for (int i = 0; i < 10; ++i) add_triangle(scene, c, a, b);
    for (const auto& engine : all_sets(scene, team)) {
      Random random(2);
      for (int i = 0; i < 500; ++i) {
        const Vec3 target = point_on({a, b, c}, random);
        const Vec3 origin = target + random.in_cube(1);
        const bool front = dot(cross(b - a, c - a), origin - a) > 0;
        const Hit hit = engine->nearest(origin, target - origin, 0);
        CHECK_EQUAL(hit.patch, front ? first : first + 2);
        CHECK(!hit.back);
      }
    }
  }
}

static void minimum() {
  ThreadTeam team(1);
  Scene scene;
  for (int i = 0; i < 5; ++i) add_quad(scene, {-1, -1, i * 1.0}, {2, 0, 0}, {0, 2, 0});
  for (const auto& engine : all_sets(scene, team)) {
    const Vec3 origin{0.3, 0.1, 0}, up{0, 0, 2};
    CHECK_EQUAL(engine->nearest(origin, up, 0).t, 0.5);  // t > t_min, not equal
    CHECK_EQUAL(engine->nearest(origin, up, -1e-9).t, 0.0);
    CHECK_EQUAL(engine->nearest(origin, up, 0.5).t, 1.0);
    CHECK_EQUAL(engine->nearest(origin, up, 0.5 - 1e-9).t, 0.5);
    CHECK_EQUAL(engine->nearest(origin, up, 1.7).t, 2.0);
    CHECK_EQUAL(engine->nearest(origin, up, 2).patch, -1);
    CHECK_EQUAL(engine->nearest(origin, -up, 0).patch, -1);
    CHECK_EQUAL(engine->nearest(origin, {0, 0, 0}, 0).patch, -1);
    CHECK_EQUAL(engine->nearest(origin, {1, 1, 0}, 0).patch, -1);  // within the plane
    CHECK(engine->nearest({0.3, 0.1, 9}, -up, 0).back == false);
    CHECK(engine->nearest(origin, up, 0).back == true);
    // From very far away.
    const Hit hit = engine->nearest({0.3, 0.1, 1e7}, {0, 0, -1}, 0);
    CHECK_NEAR(hit.t, 1e7 - 4, 1e-6);
  }
}

static void without_triangles() {
  ThreadTeam team(1);
  Scene scene;
  const auto check = [&] {
    for (const auto& engine : all_sets(scene, team)) {
      SegmentPacket packet;
      for (int i = 0; i < 16; ++i) set_segment(packet, i, {0, 0, 0}, {1, 1, 1}, {0, 0, 0});
      CHECK_EQUAL(engine->blocked(packet), 0u);
      CHECK_EQUAL(engine->nearest({0, 0, 0}, {1, 1, 1}, 0).patch, -1);
      CHECK_EQUAL(engine->radius(), 1.0);
    }
  };
  check();
  add_triangle(scene, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  scene.flags[0] |= patch_dropped;
  check();
}

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(soups),
      HRAD_TEST(room),
      HRAD_TEST(ties),
      HRAD_TEST(minimum),
      HRAD_TEST(without_triangles),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
