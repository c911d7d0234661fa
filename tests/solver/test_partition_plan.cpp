// What patches are expected to cost before anything is known of their light.
#include "scene/generate_solids.h"
#include "solver/partition_plan.h"
#include "support/workbench.h"

namespace {

using namespace hrad;
using namespace hrad_test;

// A square of side 2 at (x, 0, 0) that looks up: two patches.
void add_square(Scene& scene, double x) {
  int32_t corner[4];
  for (int k = 0; k < 4; ++k)
    corner[k] = static_cast<int32_t>(
        scene.add_vertex({x + (k == 1 || k == 2 ? 2.0 : 0.0), k >= 2 ? 2.0 : 0.0, 0}));
  scene.add_patch(corner[0], corner[1], corner[2], 0);
  scene.add_patch(corner[0], corner[2], corner[3], 0);
}

// Shadows begin where things stand: of two floors that with a box on it has more points of direct
// light, by rows. Links have none.
void floors_with_things_on_them_cost_more() {
  Scene scene;
  scene.bands = 1;
  scene.add_material({"wall", {0.5}, {1}});
  add_square(scene, 0);
  add_square(scene, 3);
  add_box(scene, {500, 500, 0}, {1500, 1500, 1000}, all_faces(0));
  const Workbench bench(std::move(scene));
  const Inspection inspection = inspect(bench.scene, *bench.engine, bench.exposure);
  for (const char* linking : {"rows", "clusters"}) {
    Params params;
    params.linking = linking;
    const std::vector<double> work =
        predicted_work(params, bench.state, inspection, bench.exposure);
    CHECK_EQUAL(work.size(), static_cast<size_t>(bench.scene.patch_count()));
    for (double of_patch : work) CHECK(of_patch > 0);
    CHECK_EQUAL(work[2], work[3]);
    for (size_t k : {0, 1})
      if (params.linking == "rows")
        CHECK(work[k] > 1.02 * work[2]);
      else
        CHECK_EQUAL(work[k], work[2]);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(floors_with_things_on_them_cost_more)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
