// Segments in packets against brute force, on every instruction set that this processor has.
#include "base/error.h"
#include "support/check.h"
#include "visibility/brute_force.h"
#include "visibility/kernels.h"

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
  CHECK(!engines.empty());
  return engines;
}

struct Tally {
  int64_t segments = 0, doubtful = 0, blocked = 0;
};

// All engines answer the same, and the brute-force loop agrees wherever it has no doubt.
static void compare(const Scene& scene,
                    const std::vector<std::unique_ptr<VisibilityEngine>>& engines,
                    const SegmentPacket& packet, Tally& tally) {
  const uint32_t answer = engines[0]->blocked(packet);
  for (const auto& engine : engines) CHECK_EQUAL(engine->blocked(packet), answer);
  CHECK_EQUAL(answer & ~packet.active, 0u);
  const double doubt = 1e-6 * engines[0]->radius();
  for (int i = 0; i < 16; ++i) {
    if (!(packet.active >> i & 1)) continue;
    bool clear = false, doubtful = false;
    for (int64_t p = 0; p < scene.patch_count(); ++p) {
      const Crossing c =
          cross_triangle(scene.triangle(p), packet_origin(packet, i, engines[0]->center()),
                         packet_direction(packet, i), doubt);
      clear = clear || c.clear;
      doubtful = doubtful || c.doubtful;
    }
    const bool blocked = answer >> i & 1;
    ++tally.segments;
    tally.blocked += blocked;
    if (clear)
      CHECK(blocked);
    else if (doubtful)
      ++tally.doubtful;
    else
      CHECK(!blocked);
  }
}

static void soups() {
  ThreadTeam team(1);
  Tally tally;
  for (int64_t triangles : {1, 2, 7, 8, 9, 60, 500}) {
    const Scene scene = random_soup(triangles, triangles > 100 ? 0.2 : 0.8, 11 + triangles);
    const auto engines = all_sets(scene, team);
    Random random(triangles);
    for (int i = 0; i < 150; ++i) {
      const Triangle a = scene.triangle(random.below(triangles));
      const Triangle b = scene.triangle(random.below(triangles));
      compare(scene, engines,
              packet_between(a, b, engines[0]->offset(), engines[0]->center(), random), tally);
      compare(scene, engines, loose_packet({-1, -1, -1}, {1, 1, 1}, engines[0]->center(), random),
              tally);
    }
  }
  CHECK(tally.blocked > tally.segments / 20);
  CHECK(tally.blocked < tally.segments * 19 / 20);
  // Triangles that look at themselves make for doubt.
  CHECK(tally.doubtful < tally.segments / 20);
}

static void room() {
  ThreadTeam team(1);
  const Scene scene = room_with_boxes(60, 5);
  const auto engines = all_sets(scene, team);
  Random random(3);
  Tally tally;
  for (int i = 0; i < 1500; ++i) {
    const Triangle a = scene.triangle(random.below(scene.patch_count()));
    const Triangle b = scene.triangle(random.below(scene.patch_count()));
    compare(scene, engines,
            packet_between(a, b, engines[0]->offset(), engines[0]->center(), random), tally);
  }
  CHECK(tally.blocked > 0);
  CHECK(tally.doubtful < tally.segments / 50);
}

// Between a floor and a ceiling straight up, and along the other axes: directions with zeros.
static void parallel_to_axes() {
  ThreadTeam team(1);
  const Scene scene = room_with_boxes(60, 6);
  const auto engines = all_sets(scene, team);
  Random random(4);
  Tally tally;
  for (int i = 0; i < 900; ++i) {
    SegmentPacket packet;
    const Vec3 corner{random.between(0.2, 11), random.between(0.2, 8), random.between(0.2, 2)};
    const bool one_line = i % 2 == 0;
    for (int k = 0; k < 16; ++k) {
      Vec3 from = corner + Vec3{random.unit(), random.unit(), random.unit()} * (one_line ? 0 : 0.6);
      Vec3 to = from;
      if (i % 3 == 0) from.x = 0.0003, to.x = 11.9997;
      if (i % 3 == 1) from.y = 8.9997, to.y = 0.0003;
      if (i % 3 == 2) from.z = 0.0003, to.z = 2.9997;
      set_segment(packet, k, from, to, engines[0]->center());
    }
    compare(scene, engines, packet, tally);
  }
  CHECK(tally.blocked > 0);
  CHECK(tally.blocked < tally.segments);
}

static void masks() {
  ThreadTeam team(1);
  Scene scene;
  add_quad(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  for (const auto& engine : all_sets(scene, team)) {
    SegmentPacket packet;
    for (int i = 0; i < 16; ++i) {
      const double x = i < 8 ? 0 : 5;  // the second half passes beside
      set_segment(packet, i, {x, 0.1, 1}, {x, 0.1, -1}, engine->center());
    }
    CHECK_EQUAL(engine->blocked(packet), 0x00ffu);
    packet.active = 0;
    CHECK_EQUAL(engine->blocked(packet), 0u);
    packet.active = 0x8181;
    // What is not looked at may hold anything.
    for (int i = 1; i < 7; ++i) packet.ox[i] = packet.dy[i] = NAN;
    CHECK_EQUAL(engine->blocked(packet), 0x0081u);
    packet.active = 0x0008;
    packet.ox[3] = packet.dy[3] = 0;
    CHECK_EQUAL(engine->blocked(packet), 0x0008u);
  }
}

// Both ends on the triangle, or beyond it on the same side: not strictly between.
static void ends() {
  ThreadTeam team(1);
  Scene scene;
  add_triangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  add_triangle(scene, {0, 0, 1}, {1, 0, 1}, {0, 1, 1});
  for (const auto& engine : all_sets(scene, team)) {
    const double d = engine->offset();
    SegmentPacket packet;
    set_segment(packet, 0, {0.2, 0.2, d}, {0.3, 0.3, 1 - d}, engine->center());
    set_segment(packet, 1, {0.2, 0.2, -d}, {0.3, 0.3, 1 - d}, engine->center());
    set_segment(packet, 2, {0.2, 0.2, d}, {0.3, 0.3, 1 + d}, engine->center());
    set_segment(packet, 3, {0.2, 0.2, -1}, {0.3, 0.3, -d}, engine->center());
    set_segment(packet, 4, {0.2, 0.2, d}, {0.7, 0.1, d}, engine->center());  // along the floor
    CHECK_EQUAL(engine->blocked(packet), 0x6u);
  }
}

// Through edges and corners of a closed box, seen from inside: no segment gets out.
static void edges_and_corners() {
  ThreadTeam team(1);
  Scene scene;
  add_box(scene, {-1, -1, -1}, {1, 1, 1}, true);
  for (const auto& engine : all_sets(scene, team)) {
    for (int x = -4; x <= 4; ++x)
      for (int y = -4; y <= 4; ++y)
        for (int z = -4; z <= 4; ++z) {
          if (!x && !y && !z) continue;
          SegmentPacket packet;
          for (int i = 0; i < 16; ++i)
            set_segment(packet, i, {0, 0, 0}, Vec3{x / 4.0, y / 4.0, z / 4.0} * (9.0 + i),
                        engine->center());
          CHECK_EQUAL(engine->blocked(packet), 0xffffu);
        }
  }
}

// A closed sphere of irregular triangles, far from the origin of its coordinates.
static void no_cracks() {
  ThreadTeam team(1);
  Scene scene;
  scene.add_material({});
  const Vec3 middle{1000, -2000, 500};
  const int rings = 40, sectors = 64;
  const double pi = 3.14159265358979323846;
  Random random(9);
  for (int r = 0; r <= rings; ++r)
    for (int s = 0; s < sectors; ++s) {
      const bool pole = r == 0 || r == rings;
      const double theta = pi * (r + (pole ? 0 : random.between(-0.4, 0.4))) / rings;
      const double phi = 2 * pi * (s + (pole ? 0 : random.between(-0.4, 0.4))) / sectors;
      scene.add_vertex(middle + Vec3{std::sin(theta) * std::cos(phi),
                                     std::sin(theta) * std::sin(phi), std::cos(theta)} *
                                    (pole ? 3 : random.between(2.5, 3.5)));
    }
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < sectors; ++s) {
      const auto at = [&](int ring, int sector) {
        return ring == 0 ? 0 : ring == rings ? rings * sectors : ring * sectors + sector % sectors;
      };
      if (r > 0) scene.add_patch(at(r, s), at(r + 1, s), at(r, s + 1), 0);
      if (r < rings - 1) scene.add_patch(at(r, s + 1), at(r + 1, s), at(r + 1, s + 1), 0);
    }
  const auto engine = make_visibility_engine(scene, "builtin", "auto", team);
  int64_t leaks = 0;
  const int64_t packets = 100000;
  for (int64_t i = 0; i < packets; ++i) {
    SegmentPacket packet;
    // Every other packet aims at points on edges.
    const Triangle t = scene.triangle(random.below(scene.patch_count()));
    for (int k = 0; k < 16; ++k) {
      const Vec3 from = middle + random.in_cube(0.5);
      const double along = random.unit();
      const Vec3 to = i % 2 ? t.a * along + t.b * (1 - along) : middle + random.in_cube(9);
      const Vec3 d = normalized(to - from);
      set_segment(packet, k, from, from + d * 20, engine->center());
    }
    leaks += __builtin_popcount(0xffffu & ~engine->blocked(packet));
    const Vec3 from = middle + random.in_cube(0.5);
    const double along = random.unit();
    if (engine->nearest(from, t.b * along + t.c * (1 - along) - from, 0).patch < 0) ++leaks;
  }
  CHECK(leaks < packets * 17 / 1000000 + 1);
}

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(soups),     HRAD_TEST(room), HRAD_TEST(parallel_to_axes),
      HRAD_TEST(masks),     HRAD_TEST(ends), HRAD_TEST(edges_and_corners),
      HRAD_TEST(no_cracks),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
