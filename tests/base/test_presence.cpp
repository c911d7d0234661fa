// Which of many things have something, against a plain list.
#include <vector>

#include "base/hash.h"
#include "base/presence.h"
#include "support/check.h"

namespace {

using namespace hrad;

void check_same(const Presence& presence, const std::vector<bool>& has) {
  CHECK_EQUAL(presence.size(), has.size());
  std::vector<size_t> with;
  for (size_t k = 0; k < has.size(); ++k) {
    CHECK_EQUAL(presence[k], has[k]);
    CHECK_EQUAL(presence.place(k), with.size());
    if (has[k]) with.push_back(k);
  }
  CHECK_EQUAL(presence.count(), with.size());
  std::vector<size_t> visited;
  presence.for_each([&](size_t k) { visited.push_back(k); });
  CHECK(visited == with);
}

// Few, half, most and all of them, and sizes around those of a word.
void places_are_counted() {
  for (uint64_t share : {0u, 1u, 50u, 99u, 100u})
    for (size_t size : {0, 1, 63, 64, 65, 128, 1000}) {
      Presence presence;
      std::vector<bool> has;
      std::vector<uint64_t> words((size + Presence::of_a_word - 1) / Presence::of_a_word, 0);
      for (size_t k = 0; k < size; ++k) {
        has.push_back(mix(k, share) % 100 < share);
        presence.push_back(has.back());
        words[k / Presence::of_a_word] |= uint64_t{has.back()} << k % Presence::of_a_word;
      }
      check_same(presence, has);
      check_same(Presence(size, words), has);
    }
}

void those_behind_have_nothing() {
  Presence presence;
  std::vector<bool> has;
  for (size_t more : {1, 62, 1, 70, 200}) {
    presence.resize(presence.size() + more);
    has.resize(has.size() + more);
    check_same(presence, has);
    presence.push_back(true);
    has.push_back(true);
    check_same(presence, has);
  }
  for (size_t size : {300, 256, 255, 64, 1, 0, 100}) {
    presence.resize(size);
    has.resize(size);
    check_same(presence, has);
  }
  presence.shrink_to_fit();
  check_same(presence, has);
  CHECK(presence.bytes() >= static_cast<int64_t>(presence.size() / 8));
  CHECK(presence.bytes() <= static_cast<int64_t>(presence.size() / 4 + 16));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(places_are_counted),
      HRAD_TEST(those_behind_have_nothing),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
