// What the tests of checkpoints share: a folder of their own, solvers, files as bytes.
#pragma once

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <string>

#include "base/error.h"
#include "solver/solver.h"
#include "support/check.h"

namespace hrad_test {

// A folder that is gone when the test is.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() /
              ("hrad-" + name + "-" + std::to_string(std::random_device()()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  // How many files are there.
  int64_t count() const {
    return std::distance(std::filesystem::directory_iterator(path_),
                         std::filesystem::directory_iterator());
  }

 private:
  std::filesystem::path path_;
};

inline std::string bytes_of_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

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
