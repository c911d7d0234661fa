// A small solved room for tests of exports, and files read back.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "solver/solver.h"
#include "support/check.h"

namespace hrad_test {

using hrad::Material;
using hrad::Solver;
namespace fs = std::filesystem;

// A folder of its own for one test.
class Folder {
 public:
  Folder() : path_((fs::temp_directory_path() / "hrad-export-XXXXXX").string()) {
    CHECK(mkdtemp(path_.data()) != nullptr);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  bool empty() const { return fs::is_empty(path_); }

 private:
  std::string path_;
};

inline std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  CHECK(file.good());
  std::ostringstream content;
  content << file.rdbuf();
  return content.str();
}

// A closed box of two bands with a two-sided panel in it: lit from the ceiling.
inline void make_room(Solver& solver) {
  solver.set_int("bands", 2);
  solver.set_double("accuracy", 0.3);
  Material wall{"wall", {0.5, 0.25}, {0, 0}, false, false};
  Material lamp{"lamp", {0, 0}, {10, 3}, false, false};
  Material panel{"panel", {0.7, 0.1}, {0, 0}, true, false};
  for (const Material& m : {wall, lamp, panel}) solver.add_material(m);
  const double xyz[] = {0,   0,   0,   3,   0,   0,   3,   2,   0,   0,   2,   0,
                        0,   0,   2.5, 3,   0,   2.5, 3,   2,   2.5, 0,   2,   2.5,
                        0.5, 0.5, 1,   1.5, 0.5, 1,   1.5, 1.5, 1.1, 0.5, 1.5, 1.1};
  const int64_t corners[] = {0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6, 0, 5, 1, 0, 4, 5,  3, 2,  6,
                             3, 6, 7, 0, 3, 7, 0, 7, 4, 1, 5, 6, 1, 6, 2, 8, 9, 10, 8, 10, 11};
  const int32_t materials[] = {0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 2, 2};
  solver.add_patches(12, xyz, 14, corners, materials);
}

// Solved once for all tests.
inline const Solver& solved() {
  static const std::unique_ptr<Solver> solver = [] {
    auto s = std::make_unique<Solver>();
    make_room(*s);
    s->set_text("up", "y");
    CHECK(static_cast<int>(s->solve()) >= 0);
    return s;
  }();
  return *solver;
}

constexpr int bands = 2;

}  // namespace hrad_test
