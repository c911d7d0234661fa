// Who computes the links between two owners' surfaces: one of the two, the same in both orders, and
// the work is shared.
#include "stages/remote_links.h"

#include <algorithm>
#include <vector>

#include "support/check.h"

namespace {

using hrad::RemoteLinks;

std::vector<int32_t> owners_with(const std::vector<int>& surfaces) {
  std::vector<int32_t> owner;
  for (size_t k = 0; k < surfaces.size(); ++k)
    owner.insert(owner.end(), static_cast<size_t>(surfaces[k]), static_cast<int32_t>(k));
  return owner;
}

// Pairs of surfaces that each owner looks at.
std::vector<int64_t> work_of(const std::vector<int>& surfaces) {
  const RemoteLinks links(static_cast<int>(surfaces.size()), owners_with(surfaces));
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
  const RemoteLinks links(2, owners_with({100, 10}));
  CHECK_EQUAL(links.computed_by(0, 1), 1);
  const RemoteLinks other(2, owners_with({10, 100}));
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
