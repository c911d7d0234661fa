// Who computes the links between two owners' surfaces: one of the two, the same in both orders, and
// the work is shared.
#include <algorithm>
#include <vector>

#include "stages/remote_links.h"
#include "support/check.h"

namespace {

using hrad::RemoteLinks;

// Pairs between owners of so many surfaces, all of which face each other.
std::vector<uint64_t> pairs_of(const std::vector<int>& surfaces) {
  const size_t owners = surfaces.size();
  std::vector<uint64_t> pairs(owners * owners, 0);
  for (size_t a = 0; a < owners; ++a)
    for (size_t b = a; b < owners; ++b) {
      const auto n = static_cast<uint64_t>(surfaces[a]), m = static_cast<uint64_t>(surfaces[b]);
      // Either order is as good.
      pairs[b % 2 ? a * owners + b : b * owners + a] = a == b ? n * (n - (n > 0)) / 2 : n * m;
    }
  return pairs;
}

// Pairs of surfaces that each owner looks at.
std::vector<int64_t> work_of(const std::vector<int>& surfaces) {
  const RemoteLinks links(static_cast<int>(surfaces.size()), pairs_of(surfaces));
  std::vector<int64_t> work(surfaces.size(), 0);
  for (size_t a = 0; a < surfaces.size(); ++a)
    for (size_t b = a; b < surfaces.size(); ++b) {
      const int32_t first = static_cast<int32_t>(a), second = static_cast<int32_t>(b);
      const int32_t by = links.computed_by(first, second);
      CHECK(by == first || by == second);
      CHECK_EQUAL(links.computed_by(second, first), by);
      const int64_t n = surfaces[a], m = surfaces[b];
      work[static_cast<size_t>(by)] += a == b ? n * (n - 1) / 2 : n * m;
    }
  return work;
}

void one_of_the_two_computes() {
  for (const auto& surfaces : std::vector<std::vector<int>>{
           {7}, {7, 7}, {1, 100}, {0, 0, 5}, {3, 0, 2, 0}, {0, 0}, {1, 2, 3, 4, 5, 6, 7, 8}}) {
    int64_t all = 0, total = 0;
    for (int n : surfaces) all += n;
    for (int64_t work : work_of(surfaces)) total += work;
    CHECK_EQUAL(total, all * (all - 1) / 2);
  }
}

void equal_owners_get_equal_work() {
  for (int owners : {2, 3, 5, 8, 64}) {
    const std::vector<int64_t> work = work_of(std::vector<int>(static_cast<size_t>(owners), 100));
    const auto ends = std::minmax_element(work.begin(), work.end());
    // But for one pair of owners.
    CHECK(*ends.second - *ends.first <= 100 * 100);
  }
}

// Between an owner of few surfaces and one of many, the one with less to do computes.
void the_one_with_less_to_do_computes() {
  const RemoteLinks links(2, pairs_of({100, 10}));
  CHECK_EQUAL(links.computed_by(0, 1), 1);
  const RemoteLinks other(2, pairs_of({10, 100}));
  CHECK_EQUAL(other.computed_by(0, 1), 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(one_of_the_two_computes),
      HRAD_TEST(equal_owners_get_equal_work),
      HRAD_TEST(the_one_with_less_to_do_computes),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
