// What was done is found again, by its name and pass; what may come from a file is read within its
// bounds; loops are cut where a stop falls, and every finished task is recorded once.
#include <set>

#include "stages/link_journal.h"
#include "support/check.h"

using hrad::KnownResult;
using hrad::Link;
using hrad::LinkJournal;
using hrad::LinkStep;

namespace {

LinkJournal recording_journal(uint64_t key) {
  LinkJournal journal;
  journal.recording = true;
  journal.begin(key, 17, 3);
  return journal;
}

// The first number of each result of that name.
std::multiset<int> numbers_of(const LinkJournal& journal, uint64_t name) {
  std::multiset<int> numbers;
  journal.known(name, [&](KnownResult& result) {
    int number = 0;
    const bool good = result.take(&number, 1) && result.at_end();
    if (good) numbers.insert(number);
    return false;  // all of them
  });
  return numbers;
}

// One task, which adds so many results.
void record(LinkJournal& journal, const std::function<void(LinkStep&)>& add) {
  hrad::ThreadTeam team(1);
  CHECK(journal.for_each(
      team, 1, [](int64_t, int) {}, [](int64_t) { return true; },
      [&](LinkStep& step, int64_t) { add(step); }));
}

void record_number(LinkJournal& journal, uint64_t name, int number) {
  record(journal, [&](LinkStep& step) {
    hrad::put(step.results, &number, 1);
    step.end_task(name);
  });
}

void results_are_found_by_pass_and_name() {
  LinkJournal journal = recording_journal(1);
  journal.next_pass();
  record_number(journal, 5, 50);
  record_number(journal, 7, 70);
  record_number(journal, 5, 51);
  journal.next_pass();
  record_number(journal, 5, 500);
  // What is recorded in a pass is for the next time.
  CHECK(numbers_of(journal, 5).empty());
  LinkJournal restored = LinkJournal::restored(journal.key(), journal.rays_before,
                                               journal.pairs_before, journal.steps());
  for (LinkJournal* each : {&journal, &restored}) {
    each->begin(1, 17, 3);
    CHECK(numbers_of(*each, 5).empty());
    each->next_pass();
    CHECK((numbers_of(*each, 5) == std::multiset<int>{50, 51}));
    CHECK((numbers_of(*each, 7) == std::multiset<int>{70}));
    CHECK(numbers_of(*each, 6).empty());
    each->next_pass();
    CHECK((numbers_of(*each, 5) == std::multiset<int>{500}));
    CHECK(numbers_of(*each, 7).empty());
    each->begin(2, 17, 3);
    each->next_pass();
    CHECK(numbers_of(*each, 5).empty());
    CHECK(each->empty());
  }
}

void nothing_is_recorded_unless_wanted() {
  LinkJournal journal = recording_journal(1);
  journal.recording = false;
  journal.next_pass();
  record_number(journal, 5, 50);
  CHECK(journal.empty());
  journal.recording = true;
  record(journal, [](LinkStep&) {});
  CHECK(journal.empty());
}

bool is_below_ten(hrad::NodeId source) { return source >= 0 && source < 10; }

// Of a task that is there twice one result may be bad: whichever comes first, the good one counts.
void a_bad_result_leaves_no_trace() {
  const std::vector<Link> good = {{3, 0.5f}, {9, 1.0f}}, bad = {{3, 0.25f}, {1 << 30, 1.0f}};
  for (const bool bad_first : {true, false}) {
    LinkJournal journal = recording_journal(1);
    journal.next_pass();
    record(journal, [&](LinkStep& step) {
      step.add_run(5, bad_first ? bad : good, bad_first ? 7 : 8);
      step.add_run(5, bad_first ? good : bad, bad_first ? 8 : 7);
    });
    journal.begin(1, 17, 3);
    journal.next_pass();
    std::vector<Link> links;
    int64_t rays = 0;
    CHECK(journal.known_run(5, is_below_ten, links, rays));
    CHECK_EQUAL(rays, int64_t{8});
    CHECK_EQUAL(links.size(), size_t{2});
    CHECK(links[0].source == 3 && links[0].weight == 0.5f && links[1].source == 9);
  }
}

void runs_are_taken_where_they_fit() {
  LinkJournal journal = recording_journal(1);
  journal.next_pass();
  const std::vector<std::vector<Link>> runs = {
      {{3, 0.5f}, {9, 1.0f}}, {{10, 0.5f}}, {{3, -0.5f}}, {{3, NAN}}, {}};
  record(journal, [&](LinkStep& step) {
    for (size_t k = 0; k < runs.size(); ++k)
      step.add_run(k, runs[k], 100 + static_cast<int64_t>(k));
    step.add_run(5, runs[0], -1);
  });
  journal.begin(1, 17, 3);
  journal.next_pass();
  std::vector<Link> links = {{1, 1}};
  int64_t rays = 0;
  CHECK(journal.known_run(0, is_below_ten, links, rays));
  CHECK(links.size() == 3 && links[2].source == 9 && rays == 100);
  for (uint64_t name : {1, 2, 3, 5, 6}) CHECK(!journal.known_run(name, is_below_ten, links, rays));
  CHECK(links.size() == 3 && rays == 100);
  CHECK(journal.known_run(4, is_below_ten, links, rays));
  CHECK(links.size() == 3 && rays == 104);
}

void reading_stays_within_bounds() {
  hrad::Bytes bytes;
  hrad::put_list(bytes, std::vector<int>{1, 2, 3});
  for (size_t size = 0; size < bytes.size(); ++size) {
    KnownResult cut(bytes.data(), size);
    std::vector<int> list;
    CHECK(!cut.take_list(list) && !cut.at_end());
    char more;
    CHECK(!cut.take(&more, 1));
  }
  // A length that no memory would be enough for.
  const uint64_t huge = ~uint64_t{0} / sizeof(int);
  hrad::Bytes lying;
  hrad::put(lying, &huge, 1);
  KnownResult result(lying.data(), lying.size());
  std::vector<int> list;
  CHECK(!result.take_list(list) && list.empty());
}

void finished_tasks_are_recorded_once() {
  constexpr int64_t count = 400;
  for (int threads : {1, 3}) {
    hrad::ThreadTeam team(threads);
    for (int64_t stop : {int64_t{0}, int64_t{1}, int64_t{150}, count, count + 1}) {
      LinkJournal journal = recording_journal(1);
      journal.next_pass();
      std::vector<int> done(count, 0), recorded(count, 0);
      const bool going_on = journal.for_each(
          team, count, [&](int64_t task, int) { ++done[static_cast<size_t>(task)]; },
          [&](int64_t finished) { return finished < stop; },
          [&](LinkStep& step, int64_t task) {
            ++recorded[static_cast<size_t>(task)];
            step.end_task(static_cast<uint64_t>(task));
          });
      CHECK(going_on == (stop > count));
      CHECK(done == recorded);
      CHECK(done.front() == 1);
      if (stop < count && threads == 1) CHECK(done.back() == 0);
      if (stop >= count) CHECK(done.back() == 1);
      journal.begin(1, 17, 3);
      journal.next_pass();
      for (size_t task = 0; task < done.size(); ++task)
        CHECK(journal.known(task, [](KnownResult&) { return true; }) == (done[task] == 1));
    }
    LinkJournal silent;
    bool any = false;
    CHECK(silent.for_each(
        team, count, [](int64_t, int) {}, [](int64_t) { return true; },
        [&](LinkStep&, int64_t) { any = true; }));
    CHECK(!any && silent.empty());
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(results_are_found_by_pass_and_name), HRAD_TEST(nothing_is_recorded_unless_wanted),
      HRAD_TEST(a_bad_result_leaves_no_trace),       HRAD_TEST(runs_are_taken_where_they_fit),
      HRAD_TEST(reading_stays_within_bounds),        HRAD_TEST(finished_tasks_are_recorded_once),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
