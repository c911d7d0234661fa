// The table of links against plain arrays of arrays.
#include <algorithm>
#include <vector>

#include "base/hash.h"
#include "links/link_table.h"
#include "machine/thread_team.h"
#include "support/check.h"

namespace {

using namespace hrad;
using namespace hrad_test;

using Rows = std::vector<std::vector<Link>>;

std::vector<Link> some_links(uint64_t key) {
  std::vector<Link> links;
  for (uint64_t k = 0; k < mix(key, 1) % 5; ++k)
    links.push_back({static_cast<NodeId>(mix(key, k, 2) % 1000), static_cast<float>(key)});
  return links;
}

void check_same(const LinkTable& table, const Rows& rows) {
  CHECK_EQUAL(table.size(), rows.size());
  int64_t count = 0;
  for (size_t k = 0; k < rows.size(); ++k) {
    const Span<const Link> run = table[k].links();
    CHECK_EQUAL(run.size(), rows[k].size());
    CHECK_EQUAL(table[k].count(), static_cast<int32_t>(rows[k].size()));
    for (size_t l = 0; l < run.size(); ++l)
      CHECK(run[l].source == rows[k][l].source && run[l].weight == rows[k][l].weight);
    count += table[k].count();
  }
  CHECK_EQUAL(table.link_count(), count);
}

// Sizes around those of one block and of several.
constexpr size_t sizes[] = {0, 1, 1023, 1024, 1025, 2048, 5000};

void appended_runs_are_there() {
  for (size_t size : sizes) {
    LinkTable table;
    Rows rows;
    for (size_t k = 0; k < size; ++k) {
      rows.push_back(some_links(k));
      table.append(rows.back());
    }
    check_same(table, rows);
    table.shrink_to_fit();
    check_same(table, rows);
    CHECK_EQUAL(table.bytes_of_links(), table.link_count() * 8);
    int64_t with_links = 0;
    for (const std::vector<Link>& row : rows) with_links += !row.empty();
    const int64_t beside = table.bytes() - table.bytes_of_links();
    CHECK(beside >= 4 * with_links + static_cast<int64_t>(size / 8));
    if (size >= 1024)
      CHECK(beside <= LinkTable::most_bytes_of_a_receiver * static_cast<int64_t>(size));
  }
}

void new_receivers_have_no_links() {
  ThreadTeam team(3);
  LinkTable table;
  Rows rows;
  for (size_t size : sizes) {
    table.resize(size);
    rows.resize(size);
    check_same(table, rows);
    std::vector<LinkTable::NewRun> runs;
    for (size_t k = size; k-- > 0;)
      if (mix(k, size) % 3 == 0) {
        rows[k] = some_links(mix(k, size));
        runs.push_back({static_cast<NodeId>(k), rows[k]});
      }
    table.replace(std::move(runs), &team);
    check_same(table, rows);
  }
}

void dropped_receivers_take_their_links_along() {
  LinkTable table;
  Rows rows;
  for (uint64_t k = 0; k < 5000; ++k) {
    rows.push_back(some_links(k));
    table.append(rows.back());
  }
  for (size_t size : {4999, 4096, 3500, 2047, 1024, 1023, 1, 0, 1500}) {
    table.resize(size);
    rows.resize(size);
    check_same(table, rows);
    for (size_t k = 0; k < table.block_count(); ++k)
      CHECK_EQUAL(table.block(k).has_links.size(),
                  std::min(LinkTable::receivers_of_a_block, size - k * 1024));
  }
}

void some_runs_are_replaced() {
  LinkTable table;
  Rows rows;
  for (uint64_t k = 0; k < 3000; ++k) {
    rows.push_back(some_links(k));
    table.append(rows.back());
  }
  for (const std::vector<NodeId>& receivers :
       {std::vector<NodeId>{}, {0}, {2999}, {1024, 1023}, {7, 5, 2047, 2048, 6}}) {
    std::vector<LinkTable::NewRun> runs;
    for (NodeId r : receivers) {
      rows[r] = some_links(mix(static_cast<uint64_t>(r), 77));
      runs.push_back({r, rows[r]});
    }
    table.replace(std::move(runs));
    check_same(table, rows);
  }
  table.replace({{5, {}}});
  rows[5].clear();
  check_same(table, rows);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(appended_runs_are_there),
      HRAD_TEST(new_receivers_have_no_links),
      HRAD_TEST(dropped_receivers_take_their_links_along),
      HRAD_TEST(some_runs_are_replaced),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
