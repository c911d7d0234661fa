// Files for a fuzz target: some that are there and good, some that are not, and a folder to write
// in that is empty again for the next input. All in memory where there is such a file system.
#pragma once

#include <hrad/hrad.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace hrad_test {

// It is gone at the end of the process, but not where that is killed.
class Places {
 public:
  static Places& get() {
    static Places places;
    return places;
  }

  // By a drawn number; what is good is never written over.
  const char* to_read(uint8_t number) const { return path(to_read_, number); }
  const char* to_write(uint8_t number) const { return path(to_write_, number); }

  void tidy() const {
    for (const auto& entry : std::filesystem::directory_iterator(name("out")))
      std::filesystem::remove_all(entry);
  }

 private:
  Places() {
    const bool in_memory = ::access("/dev/shm", W_OK) == 0;
    std::string pattern =
        (in_memory ? "/dev/shm" : std::filesystem::temp_directory_path().string()) +
        "/hrad-fuzz-XXXXXX";
    if (!::mkdtemp(&pattern[0])) std::abort();
    root_ = pattern;
    std::filesystem::create_directory(name("out"));
    write("room.obj",
          "mtllib room.mtl\nv 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nusemtl lamp\nf 1 2 3\n"
          "usemtl wall\nf 1 3 4\nf 1 4 2\n");
    write("room.mtl", "newmtl lamp\nKd 0.2\nKe 1\nnewmtl wall\nKd 0.7 0.5 0.3\n");
    write("broken.obj", "v 0 0 0\nf 1 2 3\n");
    make_checkpoints();
    to_read_ = {name("whole.hrad"), name("begun.hrad"), name("cut.hrad"),  name("room.obj"),
                name("broken.obj"), name("none.hrad"),  name("none.obj"),  name("out"),
                name("out/a.hrad"), name("out/b.hrad"), name("out/a.obj"), ""};
    to_write_ = {name("out/a.hrad"), name("out/b.hrad"), name("out/a.csv"), name("out/a.vtu"),
                 name("out/a.ply"),  name("out/a.glb"),  name("out/a.obj"), name("out/a.xyz"),
                 name("no/a.hrad"),  name("no/a.csv"),   name("out"),       ""};
  }
  ~Places() { std::filesystem::remove_all(root_); }

  std::string name(const std::string& file) const { return root_ + "/" + file; }
  void write(const std::string& file, const std::string& bytes) const {
    std::ofstream(name(file), std::ios::binary) << bytes;
  }

  // One past the last: NULL.
  static const char* path(const std::vector<std::string>& paths, uint8_t number) {
    const size_t k = number % (paths.size() + 1);
    return k < paths.size() ? paths[k].c_str() : nullptr;
  }

  static void need(hrad_status status) {
    if (status < 0) std::abort();
  }
  static int32_t stop(const hrad_progress* progress, void*) { return progress->iteration > 1; }

  void make_checkpoints() const {
    hrad_solver* solver = nullptr;
    need(hrad_create(&solver));
    need(hrad_set_int(solver, "threads", 1));
    need(hrad_set_double(solver, "accuracy", 0.5));
    need(hrad_set_double(solver, "min_area", 0.5));
    need(hrad_make_scene(solver, "furnace"));
    need(hrad_set_progress(solver, stop, nullptr));
    need(hrad_solve(solver));
    need(hrad_write_checkpoint(solver, name("begun.hrad").c_str()));
    need(hrad_set_progress(solver, nullptr, nullptr));
    need(hrad_solve(solver));
    need(hrad_write_checkpoint(solver, name("whole.hrad").c_str()));
    hrad_destroy(&solver);
    std::ifstream in(name("whole.hrad"), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    write("cut.hrad", bytes.substr(0, bytes.size() / 2));
  }

  std::string root_;
  std::vector<std::string> to_read_, to_write_;
};

}  // namespace hrad_test
