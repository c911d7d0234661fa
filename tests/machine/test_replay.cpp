// The replay of recorded solves: schedules small enough to be worked out by hand, and what a
// recorder sees of loops and exchanges.
#include <utility>
#include <vector>

#include "machine/comm.h"
#include "machine/thread_team.h"
#include "support/check.h"
#include "support/recorder.h"
#include "support/replay.h"

using namespace hrad_test;

namespace {

Event stretch(double seconds) {
  Event event;
  event.seconds = seconds;
  return event;
}
Event loop(std::vector<double> tasks) {
  Event event;
  event.kind = Kind::loop;
  event.tasks = std::move(tasks);
  return event;
}
Event exchange(Kind kind, std::vector<int64_t> bytes = {}) {
  Event event;
  event.kind = kind;
  event.bytes = std::move(bytes);
  return event;
}

Machine machine(int threads) {
  Machine m;
  m.threads = threads;
  m.latency = 1;
  m.bandwidth = 10;
  return m;
}

double critical(const Replayed& replayed, Kind kind) {
  double sum = 0;
  for (const auto& [part, seconds] : replayed.critical)
    if (part.kind == kind) sum += seconds;
  return sum;
}

void first_free_thread_takes_the_next_task() {
  CHECK_NEAR(loop_seconds({}, 2), 0, 0);
  CHECK_NEAR(loop_seconds({3, 1, 1, 1}, 1), 6, 0);
  CHECK_NEAR(loop_seconds({3, 1, 1, 1}, 2), 3, 0);
  CHECK_NEAR(loop_seconds({1, 1, 1, 3}, 2), 4, 0);  // a large task late holds all up
  CHECK_NEAR(loop_seconds({1, 2}, 16), 2, 0);
  CHECK_NEAR(loop_seconds({1, 1, 1, 3}, 2, true), 3, 0);
}

void one_rank_waits_for_nobody() {
  const std::vector<Timeline> ranks{
      {stretch(2), exchange(Kind::tell), loop({3, 1, 1, 1}), exchange(Kind::add_up, {8})}};
  CHECK_NEAR(replay(ranks, machine(1)).seconds, 8, 1e-12);
  CHECK_NEAR(replay(ranks, machine(2)).seconds, 5, 1e-12);
}

// Rank 1 is ready at 2 and waits for rank 0 until 5; the agreement takes until 6. Messages are
// there at 8 and 9: rank 0 waits for its own, rank 1 has work until 14.
void messages_travel_while_ranks_work() {
  const std::vector<Timeline> ranks{
      {stretch(2), loop({3, 1, 1, 1}), exchange(Kind::tell),
       exchange(Kind::start_exchange, {0, 20}), loop({1}), exchange(Kind::finish_exchange)},
      {stretch(1), loop({1, 1}), exchange(Kind::tell), exchange(Kind::start_exchange, {10, 0}),
       loop({4, 4, 4}), exchange(Kind::finish_exchange)}};
  const Replayed two = replay(ranks, machine(2));
  CHECK_NEAR(two.seconds, 14, 1e-12);
  CHECK_NEAR(critical(two, Kind::serial), 2, 1e-12);
  CHECK_NEAR(critical(two, Kind::loop), 11, 1e-12);
  CHECK_NEAR(critical(two, Kind::tell), 1, 1e-12);
  CHECK_NEAR(replay(ranks, machine(1)).seconds, 21, 1e-12);
  CHECK_NEAR(replay(ranks, machine(16)).seconds, 10, 1e-12);
}

// What one rank sends to several leaves it one after the other, and arrives likewise.
void a_node_has_one_wire() {
  const auto rank = [](std::vector<int64_t> to) {
    return Timeline{exchange(Kind::start_exchange, std::move(to)), exchange(Kind::finish_exchange)};
  };
  CHECK_NEAR(replay({rank({0, 10, 10}), rank({0, 0, 0}), rank({0, 0, 0})}, machine(1)).seconds, 3,
             1e-12);
  CHECK_NEAR(replay({rank({0, 0, 10}), rank({0, 0, 10}), rank({0, 0, 0})}, machine(1)).seconds, 3,
             1e-12);
}

void all_that_others_give_arrives() {
  const auto rank = [](int64_t bytes) { return Timeline{exchange(Kind::gather_all, {bytes})}; };
  CHECK_NEAR(replay({rank(10), rank(30)}, machine(1)).seconds, 4, 1e-12);
  CHECK_NEAR(replay({rank(0), rank(0), rank(0)}, machine(1)).seconds, 2, 1e-12);
}

void ranks_that_disagree_are_found() {
  bool found = false;
  try {
    replay({{exchange(Kind::tell)}, {exchange(Kind::add_up, {8})}}, machine(1));
  } catch (const std::runtime_error&) {
    found = true;
  }
  CHECK(found);
}

void spin(double seconds) {
  const double end = thread_seconds() + seconds;
  while (thread_seconds() < end) {
  }
}

// Two ranks: a stretch, a loop whose second task is the larger, an exchange.
void a_recorder_sees_all() {
  Recorders all(2);
  on_threads(2, [&](Hub& hub, int number) {
    Recorder recorder(all, number);
    RecordingComm comm(hub, number, recorder);
    recorder.stage_begins("linking");
    spin(0.02);
    hrad::ThreadTeam team(1);
    team.set_observer(&recorder);
    team.for_each(2, [](int64_t task, int) { spin(task == 1 ? 0.04 : 0.01); });
    comm.exchange({hrad::Bytes(3), hrad::Bytes(5)});
  });
  const std::vector<Timeline> linking =
      events_of(all.recording, [](const std::string& stage) { return stage == "linking"; });
  for (const Timeline& events : linking) {
    std::vector<Kind> kinds;
    double serial = 0, tasks[2] = {0, 0};
    std::vector<int64_t> bytes;
    for (const Event& event : events) {
      if (event.kind != Kind::serial) kinds.push_back(event.kind);
      serial += event.seconds;
      for (size_t k = 0; k < event.tasks.size(); ++k) tasks[k] += event.tasks[k];
      if (event.kind == Kind::start_exchange) bytes = event.bytes;
    }
    CHECK((kinds == std::vector<Kind>{Kind::loop, Kind::tell, Kind::start_exchange, Kind::tell,
                                      Kind::finish_exchange}));
    CHECK(serial >= 0.02 && serial < 0.2);
    CHECK(tasks[0] >= 0.009 && tasks[0] < 0.2 && tasks[1] >= 0.039 && tasks[1] < 0.4);
    CHECK((bytes == std::vector<int64_t>{3, 5}));
  }
  const double seconds = replay(linking, machine(1)).seconds;
  CHECK(seconds > 0.07 && seconds < 5);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(first_free_thread_takes_the_next_task),
      HRAD_TEST(one_rank_waits_for_nobody),
      HRAD_TEST(messages_travel_while_ranks_work),
      HRAD_TEST(a_node_has_one_wire),
      HRAD_TEST(all_that_others_give_arrives),
      HRAD_TEST(ranks_that_disagree_are_found),
      HRAD_TEST(a_recorder_sees_all),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
