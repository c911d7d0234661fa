// Pairs of close ends: as many go to each part of the larger end as the smaller one sees of it.
#include "links/close_pairs.h"
#include "links/form_factor.h"
#include "support/check.h"

using namespace hrad;

namespace {

Element element(Triangle corners) {
  Element e;
  e.corners = corners;
  e.normal = normalized(corners.area_vector());
  e.centroid = corners.centroid();
  e.area = length(corners.area_vector()) / 2;
  for (Vec3 corner : {corners.a, corners.b, corners.c})
    e.radius = std::max(e.radius, length(corner - e.centroid));
  return e;
}

// A wall three units high that stands on the floor, a small triangle before it, and one that the
// wall's plane cuts in two.
const Element wall = element({{0, 0, 0}, {3, 0, 0}, {0, 0, 3}});  // looks to -y
const Element on_floor = element({{1, -0.5, 0}, {1.2, -0.5, 0}, {1, -0.3, 0}});
const Element distant = element({{1, -9, 0}, {1.2, -9, 0}, {1, -8.8, 0}});
const Element opposite = element({{0.5, -0.1, 0.5}, {0.5, -0.1, 0.6}, {0.6, -0.1, 0.5}});

Vec3 start_of(const PairSamples& s, int k) {
  return {s.packet.ox[k], s.packet.oy[k], s.packet.oz[k]};
}
Vec3 end_of(const PairSamples& s, int k) {
  return start_of(s, k) + Vec3{s.packet.dx[k], s.packet.dy[k], s.packet.dz[k]};
}

void close_is_nearer_than_its_size() {
  CHECK(is_close({on_floor, wall}) && is_close({wall, on_floor}));
  CHECK(is_close({opposite, wall}));
  CHECK(!is_close({distant, wall}) && !is_close({wall, distant}));
}

// Sums over many packets against sums of Lambert's formula over the same starting points.
void parts_get_their_share() {
  for (const Element* small : {&on_floor, &opposite}) {
    for (bool up : {true, false}) {  // the wall as the source, and as the receiver
      const Element &receiver = up ? *small : wall, &source = up ? wall : *small;
      const Triangle near_part{{0, 0, 0}, {1.5, 0, 0}, {0, 0, 1.5}};
      double factor = 0, part = 0, drawn_factor = 0, drawn_part = 0;
      const int packets = 4000;
      for (int n = 0; n < packets; ++n) {
        const uint64_t key = mix(static_cast<uint64_t>(n), 17);
        PairPoints points = pattern_of(key);
        PairSamples samples;
        draw_close_pairs(receiver, source, key, {0, 0, 0}, 0, points, samples);
        CHECK_EQUAL(samples.packet.active, all_pairs);
        for (int k = 0; k < 16; ++k) {
          const Vec3 x = up ? start_of(samples, k) : end_of(samples, k);
          const Vec3 y = up ? end_of(samples, k) : start_of(samples, k);
          CHECK(std::fabs(y.y) < 1e-6 && y.x >= -1e-6 && y.z >= -1e-6 && y.x + y.z <= 3 + 1e-5);
          factor += point_to_triangle(x, small->normal, wall.corners);
          part += point_to_triangle(x, small->normal, near_part);
          drawn_factor += samples.kernel[k] * wall.area;
          if (y.x + y.z < 1.5) drawn_part += samples.kernel[k] * wall.area;
        }
      }
      CHECK(part > 0.2 * factor && part < 0.99 * factor);
      CHECK_NEAR(drawn_factor / factor, 1, 0.01);
      CHECK_NEAR(drawn_part / part, 1, 0.01);
    }
  }
}

void the_key_draws_alone() {
  PairPoints points = pattern_of(5), again = points, other = points;
  PairSamples a, b, c;
  draw_close_pairs(on_floor, wall, 5, {0, 0, 0}, 0, points, a);
  draw_close_pairs(on_floor, wall, 5, {0, 0, 0}, 0, again, b);
  draw_close_pairs(on_floor, wall, 6, {0, 0, 0}, 0, other, c);
  int same = 0;
  for (int k = 0; k < 16; ++k) {
    CHECK_EQUAL(a.packet.dx[k], b.packet.dx[k]);
    CHECK_EQUAL(a.kernel[k], b.kernel[k]);
    CHECK_EQUAL(points.source_u[k], again.source_u[k]);
    CHECK_EQUAL(points.receiver_u[k], pattern_of(5).receiver_u[k]);  // the smaller end's stay
    same += points.source_u[k] == other.source_u[k];
  }
  CHECK(same < 8);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(close_is_nearer_than_its_size),
      HRAD_TEST(parts_get_their_share),
      HRAD_TEST(the_key_draws_alone),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
