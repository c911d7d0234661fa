// Steps between cells that touch, and only between those.
#include "stages/cell_contrast.h"
#include "support/workbench.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using namespace hrad_test;

// Two squares side by side in one plane, a third across their edge, and a fourth far away. The
// cells are the triangles themselves; each has one link, to a source of the wanted brightness.
struct Squares {
  Squares() : bench(scene()) {
    State& state = bench.state;
    state.links.resize(state.forest.nodes.size());
    brightness.of_node.assign(state.forest.nodes.size(), 1.0f);
    for (NodeId root = 0; root < state.forest.surface_count(); ++root) state.cells.push_back(root);
  }
  static Scene scene() {
    Scene scene;
    add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    add_quad(scene, {1, 0, 0}, {1, 0, 0}, {0, 1, 0});
    add_quad(scene, {2, 0, 0}, {0, 0, 1}, {0, 1, 0});
    add_quad(scene, {5, 5, 5}, {1, 0, 0}, {0, 1, 0});
    return scene;
  }
  std::vector<float> with(std::vector<float> lights) {
    std::vector<Link> link(lights.size());
    std::vector<LinkTable::NewRun> runs;
    for (size_t k = 0; k < lights.size(); ++k) {
      link[k] = {0, lights[k]};
      runs.push_back({static_cast<NodeId>(k), {&link[k], 1}});
    }
    bench.state.links.replace(runs);
    return contrast_of_cells(bench.state, brightness, CornerNames(bench.state.forest), bench.team,
                             bench.exchange);
  }

  Workbench bench;
  Brightness brightness;
};

void an_even_field_has_none() {
  Squares squares;
  for (float contrast : squares.with(std::vector<float>(8, 0.7f))) CHECK_EQUAL(contrast, 0.0f);
}

void a_step_is_seen_on_both_sides_of_it_in_its_plane() {
  Squares squares;
  const std::vector<float> contrast = squares.with({1, 1, 3, 3, 9, 9, 20, 20});
  int first = 0, second = 0;
  for (int k = 0; k < 2; ++k) first += contrast[k] > 0, second += contrast[2 + k] > 0;
  CHECK(first >= 1 && second >= 1);
  for (int k = 0; k < 4; ++k) CHECK(contrast[k] == 0 || contrast[k] == 0.25f * 2);
  for (int k = 4; k < 8; ++k) CHECK_EQUAL(contrast[k], 0.0f);
}

void sealed_cells_say_nothing_and_are_told_nothing() {
  Squares squares;
  for (NodeId k = 2; k < 4; ++k) squares.bench.state.forest.nodes.set_exposed(k, 0);
  const std::vector<float> contrast = squares.with({1, 2, 30, 30, 9, 9, 20, 20});
  for (int k = 0; k < 2; ++k) CHECK_EQUAL(contrast[k], 0.25f);
  for (int k = 2; k < 8; ++k) CHECK_EQUAL(contrast[k], 0.0f);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(an_even_field_has_none),
      HRAD_TEST(a_step_is_seen_on_both_sides_of_it_in_its_plane),
      HRAD_TEST(sealed_cells_say_nothing_and_are_told_nothing),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
