// What the tests of checkpoints share: solvers, and a folder of their own with files as bytes.
#pragma once

#include <fstream>  // before cmocka, whose fail() is a macro
#include <memory>
#include <string>

#include "base/error.h"
#include "solver/solver.h"
#include "support/check.h"
#include "support/folder.h"

namespace hrad_test {

struct SolveCase {
  const char* scene;
  const char* linking;
  const char* oracle;
  double accuracy;
  const char* detail = "points";
  int bands = 3;
};

inline std::unique_ptr<hrad::Solver> solver_of(const SolveCase& c, int threads = 1) {
  auto solver = std::make_unique<hrad::Solver>();
  solver->set_int("bands", c.bands);
  solver->set_text("linking", c.linking);
  solver->set_text("oracle", c.oracle);
  solver->set_double("accuracy", c.accuracy);
  solver->set_text("detail", c.detail);
  solver->set_int("threads", threads);
  solver->make_scene(c.scene);
  return solver;
}

}  // namespace hrad_test
