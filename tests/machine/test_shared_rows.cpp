// Rows of equal size that processes make known to each other, and values that go to one of them.
#include <algorithm>
#include <vector>

#include "base/hash.h"
#include "machine/shared_rows.h"
#include "support/check.h"
#include "support/thread_ranks.h"

namespace {

using namespace hrad;
using namespace hrad_test;

int value_at(size_t row, size_t column) { return static_cast<int>(mix(row, column) % 1000003); }

// By chance; the last of several ranks has none.
int owner_of(size_t row, int ranks) {
  return static_cast<int>(mix(row, 77) % static_cast<uint64_t>(std::max(1, ranks - 1)));
}

void every_row_is_known_to_all() {
  for (int ranks : {1, 2, 3, 5})
    for (size_t rows : {0, 1, 2047, 2048, 2049, 10000})
      for (size_t columns : {1, 3})
        for (int threads : {1, 3}) {
          std::vector<int> wrong(static_cast<size_t>(ranks), 0);
          std::vector<size_t> given(static_cast<size_t>(ranks), 0);
          on_ranks(ranks, [&](Comm& comm) {
            ThreadTeam team(threads);
            const auto owner = [&](size_t row) { return owner_of(row, ranks); };
            std::vector<int> values(rows * columns, -1);
            for (size_t k = 0; k < values.size(); ++k)
              if (owner(k / columns) == comm.rank()) values[k] = value_at(k / columns, k % columns);
            const auto rank = static_cast<size_t>(comm.rank());
            given[rank] = share_rows_of(comm, team, values, columns, owner);
            for (size_t k = 0; k < values.size(); ++k)
              wrong[rank] += values[k] != value_at(k / columns, k % columns);
          });
          size_t all = 0;
          for (size_t bytes : given) all += bytes;
          CHECK_EQUAL(all, ranks > 1 ? rows * columns * sizeof(int) : 0);
          for (int count : wrong) CHECK_EQUAL(count, 0);
        }
}

void values_go_to_their_owners() {
  constexpr size_t per_rank = 100;
  for (int ranks : {1, 2, 4}) {
    std::vector<std::vector<size_t>> got(static_cast<size_t>(ranks));
    on_ranks(ranks, [&](Comm& comm) {
      const auto rank = static_cast<size_t>(comm.rank());
      std::vector<size_t> values;
      for (size_t k = 0; k < per_rank; ++k) values.push_back(rank * per_rank + k);
      send_to_owners(comm, values, [&](size_t value) { return owner_of(value, ranks); });
      got[rank] = values;
    });
    std::vector<size_t> all;
    for (size_t rank = 0; rank < got.size(); ++rank)
      for (size_t value : got[rank]) {
        CHECK_EQUAL(owner_of(value, ranks), static_cast<int>(rank));
        all.push_back(value);
      }
    std::sort(all.begin(), all.end());
    CHECK_EQUAL(all.size(), static_cast<size_t>(ranks) * per_rank);
    for (size_t k = 0; k < all.size(); ++k) CHECK_EQUAL(all[k], k);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(every_row_is_known_to_all),
                              HRAD_TEST(values_go_to_their_owners)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
