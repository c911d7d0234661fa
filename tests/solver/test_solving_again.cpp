// A solve that misses its accuracy and is done again: that is told as soon as its error is known.
#include <string>
#include <vector>

#include "solver/checkpoint_files.h"

namespace {

using hrad::Solver;

struct Told {
  std::string stage;
  double seconds, left, fraction;
};

std::vector<Told> told_of_a_coarse_mesh() {
  Solver solver;
  std::vector<Told> told;
  solver.make_scene("cornell");
  solver.set_text("linking", "pairs");
  solver.set_int("threads", 1);
  solver.set_double("accuracy", 0.01);
  solver.set_double("min_area", 3);  // too large for it
  solver.set_progress([&](const hrad::Progress& p) {
    told.push_back({p.stage, p.seconds, p.seconds_left, p.fraction});
    return true;
  });
  CHECK(solver.solve() != hrad::Status::stopped);
  return told;
}

struct Stage {
  size_t first, last;  // calls
};

// In their order.
std::vector<Stage> stages(const std::vector<Told>& told, const std::string& name) {
  std::vector<Stage> result;
  for (size_t k = 0; k < told.size(); ++k) {
    if (told[k].stage != name) continue;
    if (k == 0 || told[k - 1].stage != name) result.push_back({k, k});
    result.back().last = k;
  }
  return result;
}

// By pairs one more round follows each time.
void one_more_round_is_foreseen() {
  const std::vector<Told> told = told_of_a_coarse_mesh();
  const std::vector<Stage> rounds = stages(told, "refine"), measuring = stages(told, "measure");
  CHECK(measuring.size() > 1);
  for (size_t k = 0; k + 1 < measuring.size(); ++k) {
    double taken = 0;
    for (const Stage& round : rounds)
      if (round.last < measuring[k].first)
        taken = told[round.last].seconds - told[round.first].seconds;
    CHECK(told[measuring[k].last].left > taken);
  }
  for (size_t k = 1; k < told.size(); ++k) CHECK(told[k].fraction >= told[k - 1].fraction);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(one_more_round_is_foreseen),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
