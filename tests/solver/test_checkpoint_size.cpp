// How large the files of whole solutions are, at the accuracy that is taken when none is asked for:
// so much for the scene, so much for a link, so much for a leaf.
#include "solver/checkpoint_files.h"
#include "support/checkpoint_frame.h"

using hrad::Section;
using namespace hrad_test;

namespace {

// zlib's of some other make may get a few percent more out of them, or less.
constexpr double bytes_of_a_link = 3.5, bytes_of_a_leaf = 24;

// In a file, compressed.
int64_t bytes_of(const std::string& file, std::initializer_list<Section> sections) {
  uint64_t bytes = 0;
  for (Section section : sections)
    bytes += little_endian(file, head_bytes + static_cast<size_t>(section) * entry_bytes + 16, 8);
  return static_cast<int64_t>(bytes);
}

void links_and_leaves_take_few_bytes() {
  const Folder folder("size");
  for (const char* scene : {"building", "classroom"}) {
    hrad::Solver solver;
    solver.set_int("threads", 2);
    solver.make_scene(scene);
    solver.solve();
    solver.write_checkpoint(folder.file("a.hrad"));
    const std::string file = bytes_of_file(folder.file("a.hrad"));
    const auto whole = static_cast<int64_t>(file.size());
    const int64_t of_links =
        bytes_of(file, {Section::links, Section::mean_light, Section::point_links});
    const int64_t of_scene =
        bytes_of(file, {Section::origin, Section::parameters, Section::materials, Section::vertices,
                        Section::patches});
    const auto links = static_cast<double>(solver.stats().links);
    const auto leaves = static_cast<double>(solver.leaf_count());
    CHECK(links > 1e6 && leaves > 4e4);
    CHECK(of_links > 0 && of_scene > 0 && of_links + of_scene < whole);
    CHECK(static_cast<double>(of_links) <= bytes_of_a_link * links);
    CHECK(static_cast<double>(whole - of_links - of_scene) <= bytes_of_a_leaf * leaves);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(links_and_leaves_take_few_bytes)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
