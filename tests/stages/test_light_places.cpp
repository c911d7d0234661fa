// Places for the light of some nodes: side by side for brothers, none twice, and gone with them.
#include <set>
#include <vector>

#include "stages/light_places.h"
#include "support/check.h"

namespace {

using namespace hrad;
using namespace hrad_test;

void all_nodes_have_places_to_begin_with() {
  LightPlaces places;
  places.resize(11);
  CHECK(places.of_all());
  CHECK_EQUAL(places.count(), size_t{11});
  for (NodeId k = 0; k < 11; ++k) {
    CHECK(places.has(k));
    CHECK_EQUAL(places[k], static_cast<size_t>(k));
  }
  // Of no nodes there is none, and no light to point to.
  size_t stretches = 0;
  const auto count = [&](size_t, size_t, size_t) { ++stretches; };
  places.for_each_stretch(3, 3, count);
  LightPlaces().for_each_stretch(0, 0, count);
  CHECK_EQUAL(stretches, size_t{0});
  places.for_each_stretch(3, 4, count);
  CHECK_EQUAL(stretches, size_t{1});
}

// However many roots and clusters there are before the first family.
void some_families_have_places() {
  for (size_t tops : {1, 2, 3, 4, 5, 8}) {
    LightPlaces places;
    places.keep_some(tops);
    const auto family = [&](size_t k) { return static_cast<NodeId>(tops + 4 * k); };
    places.resize(tops + 4 * 6);
    CHECK(!places.of_all());
    CHECK_EQUAL(places.count(), tops);
    for (size_t k : {4, 1, 4}) places.add_family(family(k));
    CHECK_EQUAL(places.count(), tops + 8);
    std::set<size_t> used;
    const auto look = [&](NodeId id) {
      CHECK(places.has(id));
      CHECK(places[id] < places.count());
      CHECK(used.insert(places[id]).second);
      CHECK_EQUAL(LightPlaces::OfSome(places)[id], places[id]);
    };
    for (size_t k = 0; k < tops; ++k) {
      look(static_cast<NodeId>(k));
      CHECK_EQUAL(places[static_cast<NodeId>(k)], k);
    }
    for (size_t k = 0; k < 6; ++k)
      for (NodeId c = 0; c < 4; ++c) {
        if (k != 4 && k != 1) {
          CHECK(!places.has(family(k) + c));
          continue;
        }
        look(family(k) + c);
        CHECK_EQUAL(places[family(k) + c], places[family(k)] + static_cast<size_t>(c));
      }
  }
}

void stretches_are_all_places_of_a_range() {
  LightPlaces places;
  places.keep_some(6);
  places.resize(6 + 4 * 5);
  places.add_family(10);
  places.add_family(6);
  places.add_family(22);
  for (size_t begin = 0; begin <= 26; ++begin)
    for (size_t end = begin; end <= 26; ++end) {
      std::vector<size_t> found, wanted;
      places.for_each_stretch(begin, end, [&](size_t node, size_t place, size_t count) {
        CHECK(count > 0);
        for (size_t k = 0; k < count; ++k) {
          found.push_back(node + k);
          CHECK_EQUAL(place + k, places[static_cast<NodeId>(node + k)]);
        }
      });
      for (size_t k = begin; k < end; ++k)
        if (places.has(static_cast<NodeId>(k))) wanted.push_back(k);
      CHECK(found == wanted);
    }
}

void dropped_nodes_give_back_theirs() {
  LightPlaces places;
  places.keep_some(3);
  CHECK_EQUAL(places.end_of_own(), size_t{3});
  places.resize(3 + 4 * 2);
  places.add_own_family(3);
  const size_t before = places.count();
  CHECK_EQUAL(places.end_of_own(), before);
  places.resize(3 + 4 * 4);
  places.add_family(15);
  CHECK_EQUAL(places.end_of_own(), before);
  places.add_own_family(11);
  CHECK_EQUAL(places.count(), before + 8);
  CHECK_EQUAL(places.end_of_own(), before + 8);
  places.resize(3 + 4 * 2);
  CHECK_EQUAL(places.count(), before);
  CHECK_EQUAL(places.end_of_own(), before);
  places.resize(3 + 4 * 4);
  CHECK(places.has(3) && !places.has(11) && !places.has(15));
  places.add_family(11);
  CHECK_EQUAL(places[11], before);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(all_nodes_have_places_to_begin_with), HRAD_TEST(some_families_have_places),
      HRAD_TEST(stretches_are_all_places_of_a_range), HRAD_TEST(dropped_nodes_give_back_theirs)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
