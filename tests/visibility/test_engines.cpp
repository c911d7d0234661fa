// The table of engines, and the two of them against each other.
#include "base/error.h"
#include "support/check.h"
#include "visibility/brute_force.h"

using namespace hrad;
using namespace hrad_test;

static void names() {
  ThreadTeam team(1);
  Scene scene = random_soup(10, 0.5, 1);
  CHECK_EQUAL(
      std::string("builtin") == make_visibility_engine(scene, "builtin", "auto", team)->name(),
      true);
  CHECK(!make_visibility_engine(scene, "builtin", "sse2", team)->version().empty());
  CHECK_FAILS(make_visibility_engine(scene, "optix", "auto", team), Status::argument, "embree");
  CHECK_FAILS(make_visibility_engine(scene, "builtin", "avx1024", team), Status::argument, "sse2");
  scene.vertices[4].y = NAN;
  CHECK_FAILS(make_visibility_engine(scene, "builtin", "auto", team), Status::scene, "patch 1");
  scene.vertices[4].y = 1e200;
  CHECK_FAILS(make_visibility_engine(scene, "builtin", "auto", team), Status::scene, "unit");
}

// The same scene in other units and elsewhere gives the same answers.
static void units() {
  ThreadTeam team(1);
  const Scene scene = room_with_boxes(30, 3);
  const auto engine = make_visibility_engine(scene, "builtin", "auto", team);
  for (double unit : {1.0 / 1048576, 1048576.0}) {
    Scene scaled = scene;
    for (Vec3& v : scaled.vertices) v = v * unit;
    const auto other = make_visibility_engine(scaled, "builtin", "auto", team);
    Random random(1), again(1);
    for (int i = 0; i < 500; ++i) {
      const int64_t a = random.below(scene.patch_count()), b = random.below(scene.patch_count());
      again.below(1), again.below(1);
      const SegmentPacket packet = packet_between(scene.triangle(a), scene.triangle(b),
                                                  engine->offset(), engine->center(), random);
      const SegmentPacket same = packet_between(scaled.triangle(a), scaled.triangle(b),
                                                other->offset(), other->center(), again);
      CHECK_EQUAL(engine->blocked(packet), other->blocked(same));
    }
  }
}

static void threads() {
  ThreadTeam one(1), eight(8);
  const Scene scene = random_soup(20000, 0.05, 12);
  const auto a = make_visibility_engine(scene, "builtin", "auto", one);
  const auto b = make_visibility_engine(scene, "builtin", "auto", eight);
  Random random(1);
  for (int i = 0; i < 3000; ++i) {
    const SegmentPacket packet = loose_packet({-1, -1, -1}, {1, 1, 1}, a->center(), random);
    CHECK_EQUAL(a->blocked(packet), b->blocked(packet));
    const Vec3 origin = random.in_cube(1), direction = random.in_cube(1);
    const Hit x = a->nearest(origin, direction, 0), y = b->nearest(origin, direction, 0);
    CHECK_EQUAL(x.patch, y.patch);
    CHECK_EQUAL(x.t, y.t);
  }
}

// A packet answers as its segments do one by one, whether they lie close together or not.
static void packets_and_single_segments() {
  ThreadTeam team(1);
  const Scene scene = room_with_boxes(1500, 8);
  const auto engine = make_visibility_engine(scene, "builtin", "auto", team);
  Random random(5);
  int64_t segments = 0, differing = 0, blocked = 0;
  for (int i = 0; i < 3000; ++i) {
    SegmentPacket packet = loose_packet({0, 0, 0}, {12, 9, 3}, engine->center(), random);
    if (i % 2) {
      const Triangle a = scene.triangle(random.below(scene.patch_count()));
      const Triangle b = scene.triangle(random.below(scene.patch_count()));
      packet = packet_between(a, b, engine->offset(), engine->center(), random);
    }
    const uint32_t together = engine->blocked(packet);
    for (int k = 0; k < 16; ++k) {
      packet.active = 1u << k;
      differing += engine->blocked(packet) != (together & packet.active);
    }
    segments += 16;
    blocked += __builtin_popcount(together);
  }
  CHECK(differing <= segments / 10000);
  CHECK(blocked > segments / 4);
  CHECK(blocked < segments);
}

static bool has_embree() {
  ThreadTeam team(1);
  const Scene scene = room_with_boxes(4, 21);
  try {
    make_visibility_engine(scene, "embree", "auto", team);
  } catch (const Error& e) {
    CHECK(e.status() == Status::unsupported);
    return false;
  }
  return true;
}

static void against_embree() {
  if (!has_embree()) skip();  // jumps away: nothing may be left behind here
  ThreadTeam team(1);
  const Scene scene = room_with_boxes(400, 21);
  const auto embree = make_visibility_engine(scene, "embree", "auto", team);
  CHECK_FAILS(make_visibility_engine(scene, "embree", "avx2", team), Status::argument, "chosen");
  const auto builtin = make_visibility_engine(scene, "builtin", "auto", team);
  CHECK(embree->bytes() > 0);
  CHECK_EQUAL(embree->offset(), builtin->offset());
  Random random(6);
  int64_t segments = 0, differing = 0, other_patch = 0;
  for (int i = 0; i < 40000; ++i) {
    const Triangle a = scene.triangle(random.below(scene.patch_count()));
    const Triangle b = scene.triangle(random.below(scene.patch_count()));
    const SegmentPacket packet = packet_between(a, b, builtin->offset(), builtin->center(), random);
    segments += 16;
    differing += __builtin_popcount(builtin->blocked(packet) ^ embree->blocked(packet));
    const Vec3 origin = packet_origin(packet, 0, builtin->center());
    const Hit x = builtin->nearest(origin, packet_direction(packet, 0), 0);
    const Hit y = embree->nearest(origin, packet_direction(packet, 0), 0);
    if (x.patch != y.patch) ++other_patch;
    if (x.patch == y.patch && x.patch >= 0) {
      CHECK_EQUAL(x.t, y.t);
      CHECK_EQUAL(x.u, y.u);
    }
  }
  CHECK(differing <= segments / 10000);
  CHECK(other_patch <= 40000 / 1000);
}

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(names),          HRAD_TEST(units),
      HRAD_TEST(threads),        HRAD_TEST(packets_and_single_segments),
      HRAD_TEST(against_embree),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
