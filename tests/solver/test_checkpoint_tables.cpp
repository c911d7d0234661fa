// Files whose frame and checksums are right and whose parameters, steps of the solve, clusters or
// cells can't be: each is refused, and the message names the section and what is wrong.
#include <algorithm>
#include <vector>

#include "solver/checkpoint_sizes.h"
#include "solver/checkpoint_tree.h"
#include "solver/params.h"
#include "solver/wrong_values.h"

using hrad::NodeId;
using namespace hrad_test;

namespace {

const Good& pairs() {
  static const Good good({"cornell", "pairs", "error", 0.5});
  return good;
}

// More lamps than are looked at one by one: there are clusters, and cells besides.
const Good& many_lamps() {
  static const Good good([] {
    auto solver = std::make_unique<hrad::Solver>();
    solver->set_int("threads", 1);
    solver->set_text("linking", "rows");
    solver->set_double("accuracy", 0.3);
    solver->add_material({"wall", {0.5, 0.5, 0.5}, {0, 0, 0}});
    solver->add_material({"lamp", {0.5, 0.5, 0.5}, {100, 100, 100}});
    std::vector<double> xyz = {0, 0, 0, 20, 0, 0, 20, 2, 0, 0, 2, 0};
    std::vector<int64_t> vertex = {0, 1, 2, 0, 2, 3};
    std::vector<int32_t> material = {0, 0};
    for (int k = 0; k < 20; ++k) {
      const auto first = static_cast<int64_t>(xyz.size() / 3);
      const double x = k;
      xyz.insert(xyz.end(), {x, 1, 3, x, 1.2, 3, x + 0.2, 1, 3});
      vertex.insert(vertex.end(), {first, first + 1, first + 2});
      material.push_back(1);
    }
    solver->add_patches(static_cast<int64_t>(xyz.size() / 3), xyz.data(),
                        static_cast<int64_t>(material.size()), vertex.data(), material.data());
    return solver;
  }());
  CHECK(good.emitters > good.surfaces);
  return good;
}

// The parameters of the file, and more.
Frame with_parameters(const std::vector<std::pair<std::string, std::string>>& more,
                      const std::string& bands = "3") {
  std::vector<std::pair<std::string, std::string>> all;
  PackedReader bytes = reader_of(first_run_of(pairs().frame, Section::parameters));
  for (uint64_t count = bytes.varint(); count > 0; --count) {
    std::string name = bytes.text(100), value = bytes.text(100);
    if (name == "bands") value = bands;
    all.emplace_back(std::move(name), std::move(value));
  }
  all.insert(all.end(), more.begin(), more.end());
  PackedBytes packed;
  packed.varint(all.size());
  for (const auto& [name, value] : all) {
    packed.text(name);
    packed.text(value);
  }
  return with(pairs(), Section::parameters, packed);
}

void parameters_that_can_not_be_are_refused() {
  CHECK(file_of(with_parameters({})) == file_of(pairs().frame));
  refuses(with_parameters({{"linking", "pairs"}}), Section::parameters,
          "parameter 'linking' is there twice");
  refuses(with_parameters({{"threads", "2"}}), Section::parameters,
          "parameter 'threads' is none that decides a result");
  refuses(with_parameters({}, "1"), Section::sizes,
          "3 bands are stored and parameter 'bands' is 1");
}

// The steps of the solve: flags, counts, hashes and numbers as they were, and other lists.
Frame with_progress(const std::string& flags, const std::vector<std::vector<double>>& lists) {
  constexpr int counts = 10, hashes = 3, numbers = 9;
  const std::string& raw = first_run_of(pairs().frame, Section::progress);
  PackedReader bytes = reader_of(raw);
  for (size_t k = 0; k < flags.size(); ++k) bytes.byte();
  for (int k = 0; k < counts; ++k) bytes.varint();
  for (int k = 0; k < hashes + numbers; ++k) bytes.u64();
  PackedBytes packed;
  packed.raw(flags + raw.substr(flags.size(), raw.size() - bytes.left() - flags.size()));
  for (const std::vector<double>& list : lists) {
    packed.varint(list.size());
    for (double number : list) packed.number(number);
  }
  return with(pairs(), Section::progress, packed);
}

void steps_that_can_not_be_are_refused() {
  const std::string& raw = first_run_of(pairs().frame, Section::progress);
  const std::string flags = raw.substr(0, 8);  // the first are: begun, linked
  const std::vector<double> none, one = {1}, three = {1, 2, 3};
  Good::check_accepted(with_progress(flags, {three, three, three, three, three, three}));
  refuses(with_progress(flags, {three, one, three, three, three, three}), Section::progress,
          "1 numbers stand for 3 bands");
  refuses(with_progress(flags, {none, three, three, three, three, three}), Section::progress,
          "totals of light change that aren't there");
  refuses(with_progress(std::string("\1\0\0\0\0\0\0\0", 8), {none, none, none, none, none, none}),
          Section::progress, "it doesn't tell of links that are there");
}

// Each half of a cluster with all its surfaces but one, and within that the same again.
void halves_of_no_tree_are_refused() {
  const Good& good = many_lamps();
  const std::string& raw = first_run_of(good.frame, Section::clusters);
  const int64_t clusters = good.emitters - good.surfaces;
  PackedReader bytes = reader_of(raw);
  PackedBytes packed;
  for (int64_t k = 0; k <= clusters; ++k) packed.varint(bytes.varint());
  for (int64_t k = 0; k < clusters; ++k) bytes.varint();
  for (int64_t k = 0; k < clusters; ++k) packed.varint(static_cast<uint64_t>(clusters));
  packed.raw(raw.substr(raw.size() - bytes.left()));
  refuses(with(good, Section::clusters, packed), Section::clusters,
          "its halves of clusters make no tree");
}

void a_cluster_is_no_cell() {
  const Good& good = many_lamps();
  const std::string& raw = first_run_of(good.frame, Section::cells);
  PackedReader bytes = reader_of(raw);
  std::vector<NodeId> cells;
  int64_t cell = -1;
  while (bytes.left() > 0) {
    cell += 1 + hrad::from_zigzag(bytes.varint());
    cells.push_back(static_cast<NodeId>(cell));
  }
  const auto packed = [&] {
    PackedBytes result;
    hrad::pack_cells(cells, 0, static_cast<int64_t>(cells.size()), result);
    return result;
  };
  CHECK(packed().bytes() == raw);
  const auto element =
      std::lower_bound(cells.begin(), cells.end(), static_cast<NodeId>(good.emitters));
  CHECK(element != cells.end());
  *element = static_cast<NodeId>(good.emitters - 1);
  refuses(with(good, Section::cells, packed()), Section::cells,
          "cell " + std::to_string(*element) + " is a cluster");
}

void set_little_endian(std::string& bytes, size_t at, uint32_t value) {
  for (size_t k = 0; k < 4; ++k) bytes[at + k] = static_cast<char>(value >> (8 * k));
}

void a_section_of_another_name_is_refused() {
  std::string file = file_of(pairs().frame);
  const size_t table_bytes = hrad::section_count * entry_bytes;
  file[head_bytes + 2 * entry_bytes] ^= 1;
  set_little_endian(file, 24, hrad::checksum(0, file.data() + head_bytes, table_bytes));
  set_little_endian(file, 28, hrad::checksum(0, file.data(), 28));
  CHECK_FAILS(hrad::read_checkpoint(file, 0), hrad::Status::format,
              "section 2 should be 'sizes' and has another name");
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(parameters_that_can_not_be_are_refused),
      HRAD_TEST(steps_that_can_not_be_are_refused), HRAD_TEST(halves_of_no_tree_are_refused),
      HRAD_TEST(a_cluster_is_no_cell), HRAD_TEST(a_section_of_another_name_is_refused)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
