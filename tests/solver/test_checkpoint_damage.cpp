// Files that are damaged, cut, added to or made to do harm: each is refused as such, with the
// place, in little time and memory, or is harmless.
#include <functional>
#include <random>
#include <vector>

#include "solver/checkpoint.h"
#include "solver/checkpoint_files.h"
#include "stages/gather.h"
#include "stages/sweep.h"
#include "support/alone.h"
#include "support/checkpoint_frame.h"
#include "support/thorough.h"

using hrad::PackedBytes;
using hrad::Section;
using hrad::Status;
using namespace hrad_test;

namespace {

// stopped: in the midst of this stage, where so much of the solve is done.
std::string good_file(const SolveCase& c, const char* stopped = nullptr, double share = 0) {
  const Folder folder("good");
  const auto solver = solver_of(c);
  if (stopped) {
    solver->set_int("resumable", 1);
    solver->set_progress([=](const hrad::Progress& progress) {
      return progress.stage != std::string(stopped) || progress.stage_share < share;
    });
  }
  solver->solve();
  solver->write_checkpoint(folder.file("a.hrad"));
  return bytes_of_file(folder.file("a.hrad"));
}

// Small files of every kind of content.
const std::vector<std::string>& good_files() {
  static const std::vector<std::string> files = {
      good_file({"furnace", "rows", "error", 0.4, "points", 1}),
      good_file({"furnace", "clusters", "error", 0.5}),
      good_file({"cornell", "rows", "error", 0.5, "points", 1}),
      good_file({"furnace", "rows", "error", 0.4, "points", 1}, "linking", 0.8),
      good_file({"furnace", "pairs", "error", 0.5}, "linking", 0.2),
      good_file({"cornell", "pairs", "energy", 0.5}, "refine", 0.9),
      good_file({"furnace", "clusters", "error", 0.5}, "refine", 0.8)};
  return files;
}

// "" when the bytes can be read, else what is wrong with them.
std::string refusal_of(const std::string& bytes) {
  try {
    const auto content = hrad::read_checkpoint(bytes, 0);
    if (content->state && content->state->forest.surface_count() > 0) {
      // What can be read can be worked with.
      hrad::State& state = *content->state;
      hrad::ThreadTeam team(1);
      hrad::gather(state, team);
      hrad_test::Alone alone(state);
      hrad::push_pull(state, team, alone.exchange);
      CHECK(!state.forest.leaves().empty());
    }
    return "";
  } catch (const hrad::Error& error) {
    if (error.status() != Status::format)
      failed(__FILE__, __LINE__, std::string("not refused as damaged: ") + error.what());
    const std::string message = error.what();
    if (message.find("section '") == std::string::npos ||
        message.find(" byte ") == std::string::npos)
      failed(__FILE__, __LINE__, "no section, or no byte: " + message);
    return message;
  }
}

void refuses(const std::string& bytes, const std::string& text = "") {
  const std::string message = refusal_of(bytes);
  if (message.empty() || message.find(text) == std::string::npos)
    failed(__FILE__, __LINE__, "wanted '" + text + "', got '" + message + "'");
}

void the_files_are_good_and_made_again_the_same() {
  for (const std::string& file : good_files()) {
    CHECK(refusal_of(file).empty());
    CHECK(file_of(frame_of(file)) == file);
  }
}

void every_byte_of_the_head_counts() {
  const std::string& file = good_files()[0];
  const size_t head = head_bytes + hrad::section_count * entry_bytes;
  for (size_t at = 0; at < head; ++at)
    for (int change : {1, 0x80, 0xff}) {
      std::string bytes = file;
      bytes[at] = static_cast<char>(bytes[at] ^ change);
      refuses(bytes);
    }
}

void every_bit_counts() {
  std::mt19937_64 random(1);
  for (const std::string& file : good_files())
    for (int k = 0; k < 2500; ++k) {
      std::string bytes = file;
      const size_t at = random() % bytes.size();
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
      refuses(bytes);
    }
}

void cuts_and_additions_are_found() {
  std::mt19937_64 random(2);
  for (const std::string& file : good_files()) {
    for (size_t k = 0; k < hrad::section_count; ++k) {
      const size_t at = little_endian(file, head_bytes + k * entry_bytes + 8, 8);
      refuses(file.substr(0, at), "cut short");
      refuses(file.substr(0, at - 1), "cut short");
    }
    for (int k = 0; k < 300; ++k) refuses(file.substr(0, random() % file.size()));
    refuses(file.substr(0, file.size() - 1), "cut short");
    refuses(file + '\0', "added to");
    refuses(file + file, "added to");
    refuses(file.substr(1));
  }
  refuses("");
  // As a transfer of text changes it.
  std::string text = good_files()[0];
  text.erase(text.find('\r'), 1);
  refuses(text, "as if it were text");
}

void other_versions_are_named() {
  refuses(file_of(frame_of(good_files()[0]), 3), "version 3");
  refuses(file_of(frame_of(good_files()[0]), 0), "version 0");
}

// With right checksums: what is inside may be anything.
void any_content_is_refused_or_harmless() {
  std::mt19937_64 random(3);
  int refused = 0;
  for (const std::string& file : good_files()) {
    const Frame good = frame_of(file);
    for (int k = 0; k < (thorough() ? 800 : 300); ++k) {
      Frame frame = good;
      auto& runs = frame[random() % frame.size()];
      if (runs.empty()) continue;
      std::string& raw = runs[random() % runs.size()].raw;
      if (raw.empty()) continue;
      const size_t at = random() % raw.size();
      switch (random() % 4) {
        case 0:
          raw[at] = static_cast<char>(raw[at] ^ (1 << random() % 8));
          break;
        case 1:
          raw[at] = static_cast<char>(random());
          break;
        case 2:
          raw.insert(at, 1, static_cast<char>(random()));
          break;
        default:
          raw.erase(at, 1 + random() % 3);
      }
      refused += !refusal_of(file_of(frame)).empty();
    }
  }
  CHECK(refused > 1000);
}

// The steps of the former version are left out, whatever they are.
void steps_of_version_1_are_done_again() {
  const Folder folder("old-steps");
  Frame frame = frame_of(good_files()[3]);
  auto& steps = frame[static_cast<size_t>(Section::steps)];
  CHECK(!steps.empty());
  for (auto& run : steps) run.raw = "\1\2\3";
  write_bytes(folder.file("a.hrad"), file_of(frame, 1));
  hrad::Solver solver;
  solver.read_checkpoint(folder.file("a.hrad"));
  CHECK(solver.solve() != Status::stopped);
  const auto whole = solver_of({"furnace", "rows", "error", 0.4, "points", 1});
  whole->solve();
  CHECK(solver.state_hash() == whole->state_hash());
  CHECK_EQUAL(solver.stats().rays, whole->stats().rays);
}

// Stages take results from a file as far as they fit, and make the others.
void any_steps_are_refused_or_harmless(const std::string& file) {
  const Folder folder("steps");
  const Frame good = frame_of(file);
  const size_t steps = static_cast<size_t>(Section::steps);
  CHECK(!good[steps].empty());
  std::mt19937_64 random(4);
  int read = 0;
  for (int k = 0; k < 40; ++k) {
    Frame frame = good;
    std::string& raw = frame[steps][random() % frame[steps].size()].raw;
    const size_t at = random() % raw.size();
    raw[at] = static_cast<char>(raw[at] ^ (1 << random() % 8));
    if (k % 10 == 0) frame[steps].pop_back();
    write_bytes(folder.file("a.hrad"), file_of(frame));
    hrad::Solver solver;
    try {
      solver.read_checkpoint(folder.file("a.hrad"));
    } catch (const hrad::Error& error) {
      CHECK(error.status() == Status::format);
      continue;
    }
    ++read;
    static_cast<void>(solver.solve());
    CHECK(solver.leaf_count() > 0);
  }
  CHECK(read > 5);
}

void any_steps_of_any_method_are_refused_or_harmless() {
  for (size_t k = 3; k < good_files().size(); ++k)
    any_steps_are_refused_or_harmless(good_files()[k]);
}

// A good file with one section changed.
std::string with(Section section, const std::function<void(std::vector<FrameRun>&)>& change,
                 size_t file = 0) {
  Frame frame = frame_of(good_files()[file]);
  change(frame[static_cast<size_t>(section)]);
  return file_of(frame);
}

std::vector<uint64_t> sizes_in(const std::string& raw) {
  hrad::PackedReader reader(raw.data(), raw.size(), {"sizes", 0});
  std::vector<uint64_t> sizes;
  while (reader.left() > 0) sizes.push_back(reader.varint());
  return sizes;
}

std::string with_sizes(size_t which, uint64_t value, size_t file = 0) {
  return with(
      Section::sizes,
      [&](std::vector<FrameRun>& runs) {
        std::vector<uint64_t> sizes = sizes_in(runs[0].raw);
        sizes[which] = value;
        PackedBytes bytes;
        for (uint64_t size : sizes) bytes.varint(size);
        runs[0].raw = bytes.bytes();
      },
      file);
}

// Means of direct light are those of rows: a mesh that rounds refine has none.
void direct_light_without_rows_is_refused() {
  constexpr size_t surfaces = 4, clusters = 5, families = 6, cells = 8, receivers_of_means = 9;
  int refused = 0;
  for (size_t file = 0; file < good_files().size(); ++file) {
    const Frame frame = frame_of(good_files()[file]);
    const std::vector<uint64_t> sizes = sizes_in(frame[static_cast<size_t>(Section::sizes)][0].raw);
    const uint64_t nodes = sizes[surfaces] + sizes[clusters] + 4 * sizes[families];
    if (sizes[cells] > 0 || nodes == 0) continue;
    refuses(with_sizes(receivers_of_means, nodes, file), "don't fit together");
    ++refused;
  }
  CHECK(refused >= 2);
}

void huge_counts_are_refused() {
  for (size_t which = 0; which < 16; ++which)
    for (uint64_t value : {uint64_t{1} << 20, uint64_t{1} << 31, uint64_t{1} << 40,
                           (uint64_t{1} << 63) - 1, ~uint64_t{0}})
      refuses(with_sizes(which, value), "section 'sizes'");
}

void bombs_are_refused() {
  for (size_t size : {size_t{1} << 20, size_t{1} << 26, size_t{1} << 28}) {
    const std::string zeros(size, '\0');
    // As it is written, filled up; and as small as it gets, which no writer does.
    std::string bomb = hrad::compressed(zeros);
    bomb.erase(bomb.find_last_not_of('\0') + 1);
    for (Section section : {Section::links, Section::vertices, Section::light, Section::origin}) {
      refuses(with(section,
                   [&](std::vector<FrameRun>& runs) {
                     runs[0].stored = bomb;
                     runs[0].stated_raw = static_cast<uint32_t>(size);
                   }),
              "can't ");
      // States little and holds much.
      refuses(with(section,
                   [&](std::vector<FrameRun>& runs) {
                     runs[0].stored = bomb;
                     runs[0].stated_raw = static_cast<uint32_t>(runs[0].raw.size());
                   }),
              hrad::section_name(section));
    }
    // Nested: a bomb of bombs.
    refuses(with(Section::origin, [&](std::vector<FrameRun>& runs) {
      runs[0].stored = hrad::compressed(bomb);
      runs[0].stated_raw = static_cast<uint32_t>(size);
    }));
  }
}

// What a run states is its own: it is counted before it is expanded.
void expanded_runs_are_counted() {
  const std::string file = with(Section::origin, [&](std::vector<FrameRun>& runs) {
    runs[0].raw.assign(size_t{64} << 20, '\0');
  });
  refuses(file, "section 'origin'");
  try {
    hrad::read_checkpoint(file, int64_t{16} << 20);
    failed(__FILE__, __LINE__, "64 MiB were taken within 16 MiB");
  } catch (const hrad::Error& error) {
    CHECK(error.status() == hrad::Status::memory);
  }
}

// Replaces the first run of a section.
std::string with_bytes(Section section, const PackedBytes& bytes, size_t file = 0) {
  return with(
      section, [&](std::vector<FrameRun>& runs) { runs[0].raw = bytes.bytes(); }, file);
}

void impossible_trees_are_refused() {
  const Frame frame = frame_of(good_files()[0]);
  const std::string& tree = frame[static_cast<size_t>(Section::tree)][0].raw;
  hrad::PackedReader old(tree.data(), tree.size(), {"tree", 0});
  std::vector<int64_t> steps;
  while (old.left() > 0) steps.push_back(old.signed_varint());
  CHECK(steps.size() > 2);
  const auto refuses_steps = [&](size_t at, int64_t step, const char* text) {
    PackedBytes bytes;
    for (size_t k = 0; k < steps.size(); ++k) bytes.signed_varint(k == at ? step : steps[k]);
    refuses(with_bytes(Section::tree, bytes), text);
  };
  refuses_steps(1, 0, "has four already");
  refuses_steps(0, 100000, "section 'tree'");  // a parent behind its children: a cycle
  refuses_steps(0, -1, "section 'tree'");
  // A chain down to where elements can't be smaller.
  PackedBytes chain;
  int64_t parent = 0, next = 12;
  for (size_t k = 0; k < steps.size(); ++k, next += 4) {
    chain.signed_varint(k == 0 ? 0 : next - 4 - parent);
    parent = k == 0 ? 0 : next - 4;
  }
  if (steps.size() > 15) refuses(with_bytes(Section::tree, chain), "as small as elements can be");
}

void impossible_links_are_refused() {
  const Frame frame = frame_of(good_files()[1]);
  for (Section section : {Section::links, Section::light, Section::clusters, Section::nodes})
    for (char byte : {'\xff', '\x7f'}) {
      const std::string changed = with(
          section,
          [&](std::vector<FrameRun>& runs) { runs[0].raw.assign(runs[0].raw.size(), byte); }, 1);
      refuses(changed, hrad::section_name(section));
    }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(the_files_are_good_and_made_again_the_same),
                              HRAD_TEST(every_byte_of_the_head_counts),
                              HRAD_TEST(every_bit_counts),
                              HRAD_TEST(cuts_and_additions_are_found),
                              HRAD_TEST(other_versions_are_named),
                              HRAD_TEST(any_content_is_refused_or_harmless),
                              HRAD_TEST(steps_of_version_1_are_done_again),
                              HRAD_TEST(any_steps_of_any_method_are_refused_or_harmless),
                              HRAD_TEST(huge_counts_are_refused),
                              HRAD_TEST(direct_light_without_rows_is_refused),
                              HRAD_TEST(bombs_are_refused),
                              HRAD_TEST(expanded_runs_are_counted),
                              HRAD_TEST(impossible_trees_are_refused),
                              HRAD_TEST(impossible_links_are_refused)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
