// Light from small surfaces that are far brighter than all else: a white plate close to a lamp that
// shines on it, in a room that sees the plate alone.
#include <cmath>
#include <vector>

#include "base/angle.h"
#include "physics/view_factors.h"
#include "stages/rows_bench.h"
#include "stages/state_memory.h"

namespace {

using namespace hrad;
using namespace hrad_test;

constexpr double room_height = 2.5, plate_height = 1, lamp_height = 1.1;
constexpr double plate_edge = 0.05, lamp_edge = 0.02;
constexpr int64_t first_plate = 12, first_lamp = 14;

Scene room_with_a_lit_plate() {
  Scene scene;
  add_box(scene, {0, 0, 0}, {4, 3, room_height}, true);
  add_quad(scene, {2, 1.5, plate_height}, {plate_edge, 0, 0}, {0, plate_edge, 0});
  const double edge = (plate_edge - lamp_edge) / 2;
  add_quad(scene, {2 + edge, 1.5 + edge, lamp_height}, {0, lamp_edge, 0}, {lamp_edge, 0, 0});
  set_light(scene, 0, scene.patch_count(), 0, 0);
  set_light(scene, first_plate, 2, 0, 0.8);
  set_light(scene, first_lamp, 2, 1000, 0);
  return scene;
}

bool is_plate(const State& state, NodeId source) {
  const int64_t patch = state.forest.surfaces[state.forest.nodes[source].surface].patch;
  return patch >= first_plate && patch < first_lamp;
}

double weight_of_plate(const State& state, NodeId cell) {
  double sum = 0;
  for (const Link& link : state.links[cell].links())
    if (is_plate(state, link.source)) sum += static_cast<double>(link.weight);
  return sum;
}

// By the integrand of the form factor between grids, hidden parts left out.
double factor_to_plate(const Rows& rows, const Triangle& cell, Vec3 normal) {
  constexpr int steps = 4;
  double sum = 0;
  for (double x : {1.0 / 6, 4.0 / 6})
    for (double y : {1.0 / 6, 4.0 / 6}) {
      if (x + y > 1) continue;
      const Vec3 from = cell.at(x, y) + normal * 1e-6;
      for (int k = 0; k < steps * steps; ++k) {
        const Vec3 to{2 + plate_edge * (k % steps + 0.5) / steps,
                      1.5 + plate_edge * (k / steps + 0.5) / steps, plate_height + 1e-6};
        const Vec3 d = to - from;
        if (!(dot(d, normal) > 0) || !(d.z < 0)) continue;
        if (rows.bench.engine->nearest(from, d, 0).t < 1) continue;
        const double square = dot(d, d);
        sum += dot(d, normal) * -d.z / (pi * square * square) / 3;
      }
    }
  return sum * plate_edge * plate_edge / (steps * steps);
}

// Cells know their form factor to the plate to some percent, where a ray of theirs in ten thousand
// meets it.
void all_cells_see_the_spot() {
  Rows rows(room_with_a_lit_plate());
  CHECK(rows.link());
  const State& state = rows.bench.state;
  double error = 0, square = 0, arriving = 0;
  for (NodeId cell : state.cells) {
    const Node& node = state.forest.nodes[cell];
    const Surface& surface = state.forest.surfaces[node.surface];
    if (surface.patch >= first_plate) continue;
    const double area = state.forest.area(node), found = weight_of_plate(state, cell);
    arriving += area * found;
    const double wanted = factor_to_plate(rows, state.forest.triangle(node), surface.normal);
    error += area * (found - wanted) * (found - wanted);
    square += area * wanted * wanted;
  }
  CHECK(std::sqrt(error / square) < 0.1);
  // What the plate sends out and the lamp doesn't take.
  const double edge = (plate_edge - lamp_edge) / 2;
  const physics::Interval plate{0, plate_edge}, lamp{edge, edge + lamp_edge};
  const double to_lamp =
      physics::parallel_rectangles(plate, plate, lamp, lamp, lamp_height - plate_height);
  CHECK_NEAR(arriving / (plate_edge * plate_edge), 1 - to_lamp, 0.002);
}

// In an enclosure all that a cell sees adds up to one: rays of rows and of spots count every
// surface once. What they add up to is no matter of chance where no ray can be lost.
void spots_leave_the_rest_to_rows() {
  Scene scene = room_with_a_lit_plate();
  set_light(scene, 0, first_plate, 0, 0.5);
  Rows rows(std::move(scene));
  rows.settings.rays_of_cell = 256;
  CHECK(rows.link());
  const State& state = rows.bench.state;
  int64_t by_spots = 0, whole = 0;
  double sum = 0, of_spots = 0, area = 0;
  for (NodeId cell : state.cells) {
    const Node& node = state.forest.nodes[cell];
    if (state.forest.surfaces[node.surface].patch >= first_plate) continue;
    double all = 0;
    for (const Link& link : state.links[cell].links()) all += static_cast<double>(link.weight);
    CHECK(all <= 1 + 1e-5);
    whole += all > 1 - 1e-5;
    by_spots += weight_of_plate(state, cell) > 0;
    const double a = state.forest.area(node);
    area += a;
    sum += a * all;
    of_spots += a * weight_of_plate(state, cell);
  }
  const int64_t cells = static_cast<int64_t>(state.cells.size());
  CHECK(by_spots > cells / 2 && whole > cells / 2);
  CHECK(of_spots > 0);
  // Both sides of plate and lamp lose the rays that meet their backs.
  CHECK_NEAR(sum / area, 1, 2 * (plate_edge * plate_edge + lamp_edge * lamp_edge) / area);
}

void expect_same_rows(const State& a, const State& b) {
  CHECK_EQUAL(a.cells.size(), b.cells.size());
  CHECK_EQUAL(a.rays, b.rays);
  for (NodeId cell : a.cells) {
    CHECK_EQUAL(a.links[cell].count(), b.links[cell].count());
    const auto of_b = b.links[cell].links();
    auto other = of_b.begin();
    for (const Link& link : a.links[cell].links()) {
      CHECK(link.source == (*other).source && link.weight == (*other).weight);
      ++other;
    }
  }
}

void threads_and_stops_change_nothing() {
  Rows one(room_with_a_lit_plate(), {}, 1);
  CHECK(one.link());
  Rows three(room_with_a_lit_plate(), {}, 3);
  CHECK(three.link());
  expect_same_rows(one.bench.state, three.bench.state);
  Rows stopped(room_with_a_lit_plate());
  State& state = stopped.bench.state;
  state.journal.recording = true;
  state.journal.begin(1, 0, 0);
  StageTools tools = stopped.bench.tools({});
  int stops = 0;
  for (int64_t most = 1; most < 1 << 30; most += most) {
    int64_t asked = 0;
    tools.progress = [&](double) { return ++asked <= most; };
    if (link_rows(state, tools, stopped.settings)) break;
    ++stops;
    clear(state);
    state.rays = 0;
    stopped.bench.exchange.forget(stopped.bench.state);
    stopped.expose_roots();
    state.journal.begin(1, 0, 0);
  }
  CHECK(stops >= 3);
  expect_same_rows(one.bench.state, state);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(all_cells_see_the_spot),
      HRAD_TEST(spots_leave_the_rest_to_rows),
      HRAD_TEST(threads_and_stops_change_nothing),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
