// Sections written by several ranks on several threads: the bytes are those of one, whoever has the
// items, and what is read is what was given.
#include <algorithm>
#include <vector>

#include "api/guard.h"
#include "machine/comm_self.h"
#include "solver/checkpoint_files.h"
#include "solver/checkpoint_sink.h"
#include "solver/items_of_others.h"
#include "support/thread_ranks.h"

namespace {

using namespace hrad_test;
using hrad::CheckpointSink;
using hrad::CheckpointSource;
using hrad::Comm;
using hrad::ItemRange;
using hrad::PackedBytes;
using hrad::Section;
using hrad::SharedFile;
using hrad::ThreadTeam;

// The items of a section: none, one, and runs whose last one is short or full.
int64_t items_of(Section section) {
  constexpr int64_t runs[] = {1, 0, 40, 3};
  const auto k = static_cast<size_t>(section);
  if (hrad::items_of_run(section) == 1) return 1;
  return std::max<int64_t>(0,
                           hrad::items_of_run(section) * runs[k % 4] - static_cast<int64_t>(k % 3));
}

// What an item is: some numbers, often none.
std::vector<uint32_t> numbers_of(Section section, int64_t item) {
  const auto seed = static_cast<uint32_t>(item * 31 + static_cast<int64_t>(section));
  std::vector<uint32_t> numbers(seed * 2654435761u % 5);
  for (size_t k = 0; k < numbers.size(); ++k) numbers[k] = (seed + static_cast<uint32_t>(k)) * 97;
  return numbers;
}

constexpr int64_t own_items = 23;

// One after the other, or each at an owner of its own, whoever packs it.
bool is_owned(Section section) { return static_cast<size_t>(section) % 2 == 0; }

void pack_numbers(hrad::Span<const uint32_t> numbers, PackedBytes& bytes) {
  bytes.varint(numbers.size());
  for (uint32_t number : numbers) bytes.u32(number);
}

void write_owned(Comm& comm, CheckpointSink& sink, Section section) {
  const auto owner = [&](int64_t item) {
    return static_cast<int32_t>(item / 100 * 7 % comm.size());
  };
  hrad::ItemsOfOthers<uint32_t> others(comm, owner, [&](int64_t item, std::vector<uint32_t>& list) {
    list = owner(item) == comm.rank() ? numbers_of(section, item) : std::vector<uint32_t>{666};
  });
  const auto pack = [&](int64_t first, int64_t end, PackedBytes& bytes) {
    for (int64_t item = first; item < end; ++item)
      if (others.mine(item))
        pack_numbers(numbers_of(section, item), bytes);
      else
        pack_numbers(others[item], bytes);
  };
  sink.write(section, items_of(section), pack,
             [&](const std::vector<ItemRange>& of_rank) { others.fetch(of_rank); });
}

// first_own: of each rank, and of all behind the last one.
void write_all(Comm& comm, const std::string& path, ThreadTeam* team,
               const std::vector<int64_t>& first_own) {
  SharedFile file(comm, path);
  CheckpointSink sink(comm, file, team);
  for (size_t k = 0; k < hrad::section_count; ++k) {
    const auto section = static_cast<Section>(k);
    if (section == Section::steps) {
      const auto rank = static_cast<size_t>(comm.rank());
      sink.write_own(section, first_own[rank + 1] - first_own[rank],
                     [&](int64_t first, int64_t, PackedBytes& bytes) {
                       pack_numbers(numbers_of(section, first_own[rank] + first), bytes);
                     });
    } else if (is_owned(section)) {
      write_owned(comm, sink, section);
    } else {
      sink.write(section, items_of(section), [&](int64_t first, int64_t end, PackedBytes& bytes) {
        for (int64_t item = first; item < end; ++item)
          pack_numbers(numbers_of(section, item), bytes);
      });
    }
  }
  sink.finish();
  file.commit_keeping(0);
}

void what_is_read_is_what_was_given() {
  const Folder folder("sink");
  hrad::CommSelf comm;
  write_all(comm, folder.file("a"), nullptr, {0, own_items});
  const std::string bytes = bytes_of_file(folder.file("a"));
  hrad::MemoryBudget budget;
  const CheckpointSource source(bytes, budget);
  for (size_t k = 0; k < hrad::section_count; ++k) {
    const auto section = static_cast<Section>(k);
    int64_t items = 0;
    source.read(section, section == Section::steps ? own_items : items_of(section),
                [&](int64_t first, int64_t end, hrad::PackedReader& reader) {
                  for (int64_t item = first; item < end; ++item, ++items) {
                    std::vector<uint32_t> numbers(reader.varint());
                    for (uint32_t& number : numbers) number = reader.u32();
                    CHECK(numbers == numbers_of(section, item));
                  }
                });
    CHECK_EQUAL(items, section == Section::steps ? own_items : items_of(section));
  }
}

void any_number_writes_the_same() {
  const Folder folder("sink");
  hrad::CommSelf alone;
  write_all(alone, folder.file("a"), nullptr, {0, own_items});
  const std::string wanted = bytes_of_file(folder.file("a"));
  CHECK(wanted.size() > 100000);
  ThreadTeam team(3);
  write_all(alone, folder.file("b"), &team, {0, own_items});
  CHECK(bytes_of_file(folder.file("b")) == wanted);
  const std::vector<std::vector<int64_t>> first_own = {
      {0, 0, own_items}, {0, 5, 5, own_items}, {0, 20, 21, 22, 22, own_items}};
  for (const std::vector<int64_t>& first : first_own)
    for (int more : {0, 2}) {
      std::filesystem::remove(folder.file("b"));
      on_ranks(static_cast<int>(first.size()) - 1, [&](Comm& comm) {
        hrad::api::agreed(comm, [&] {
          // As many threads as it may be, and another number on each rank.
          ThreadTeam own(1 + more * comm.rank() % 3);
          write_all(comm, folder.file("b"), &own, first);
        });
      });
      CHECK(bytes_of_file(folder.file("b")) == wanted);
    }
}

// A section of one run is made where everything is known.
void rank_0_packs_single_runs() {
  const Folder folder("sink");
  std::vector<int> packed(4, 0);
  on_ranks(4, [&](Comm& comm) {
    hrad::api::agreed(comm, [&] {
      SharedFile file(comm, folder.file("a"));
      CheckpointSink sink(comm, file, nullptr);
      for (Section section : {Section::origin, Section::progress, Section::clusters})
        sink.write(section, 1, [&](int64_t, int64_t, PackedBytes& bytes) {
          ++packed[static_cast<size_t>(comm.rank())];
          bytes.byte(1);
        });
    });
  });
  CHECK((packed == std::vector<int>{3, 0, 0, 0}));
}

// A run that can't be packed, on one rank alone, in any of the batches.
void one_rank_can_not_pack() {
  const Folder folder("sink");
  constexpr int64_t runs = 40;
  for (int64_t bad = 0; bad < runs; bad += 3) {
    std::vector<std::string> messages(3);
    on_ranks(3, [&](Comm& comm) {
      try {
        hrad::api::agreed(comm, [&] {
          SharedFile file(comm, folder.file("a"));
          CheckpointSink sink(comm, file, nullptr);
          sink.write(Section::links, runs * hrad::items_of_run(Section::links),
                     [&](int64_t first, int64_t, PackedBytes& bytes) {
                       if (first / hrad::items_of_run(Section::links) == bad)
                         throw hrad::Error(hrad::Status::unsupported, "run " + std::to_string(bad));
                       bytes.byte(1);
                     });
          file.commit_keeping(0);
        });
      } catch (const hrad::Error& error) {
        messages[static_cast<size_t>(comm.rank())] = error.what();
      }
    });
    for (const std::string& message : messages) CHECK(message == "run " + std::to_string(bad));
    CHECK_EQUAL(folder.count(), 0);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(what_is_read_is_what_was_given),
      HRAD_TEST(any_number_writes_the_same),
      HRAD_TEST(rank_0_packs_single_runs),
      HRAD_TEST(one_rank_can_not_pack),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
