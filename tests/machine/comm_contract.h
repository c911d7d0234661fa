// What every Comm promises (machine/comm.h), told as functions that all ranks run: tests call them
// over one process, over threads and over MPI.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "machine/comm.h"
#include "support/check.h"

namespace comm_contract {

using hrad::Bytes;
using hrad::Comm;
using hrad::Status;

// Bytes that tell who made them for whom, and which.
inline Bytes bytes_of(int from, int to, size_t size) {
  Bytes bytes(size);
  for (size_t k = 0; k < size; ++k)
    bytes[k] = static_cast<char>(37 * from + 101 * to + 7 * static_cast<int>(k % 251));
  return bytes;
}

// How many bytes one rank has for another in a turn: none, few, many.
inline size_t size_of(int from, int to, int turn) {
  constexpr size_t sizes[] = {0, 1, 13, 0, 70000, 5, 1 << 20};
  return sizes[static_cast<size_t>(3 * from + 5 * to + turn) % 7];
}

inline std::vector<Bytes> outgoing(const Comm& comm, int turn) {
  std::vector<Bytes> to;
  for (int k = 0; k < comm.size(); ++k)
    to.push_back(bytes_of(comm.rank(), k, size_of(comm.rank(), k, turn)));
  return to;
}

inline bool is_incoming(const Comm& comm, int turn, const std::vector<Bytes>& from) {
  bool right = static_cast<int>(from.size()) == comm.size();
  for (int k = 0; right && k < comm.size(); ++k)
    right = from[k] == bytes_of(k, comm.rank(), size_of(k, comm.rank(), turn));
  return right;
}

inline void ranks_are_in_order(Comm& comm) {
  CHECK(comm.size() >= 1);
  CHECK(comm.rank() >= 0 && comm.rank() < comm.size());
  CHECK_EQUAL(comm.alone(), comm.size() == 1);
  const auto all = comm.gather_all({static_cast<char>(comm.rank())});
  CHECK_EQUAL(static_cast<int>(all.size()), comm.size());
  for (int k = 0; k < comm.size(); ++k) CHECK(all[k] == Bytes{static_cast<char>(k)});
}

inline void broadcast_gives_rank_0s(Comm& comm) {
  for (size_t size : {size_t{0}, size_t{1}, size_t{1000}, size_t{3} << 20}) {
    Bytes data = bytes_of(comm.rank(), 0, comm.rank() == 0 ? size : 17 * size_t(comm.rank()));
    comm.broadcast(data);
    CHECK(data == bytes_of(0, 0, size));
  }
}

inline void gather_all_gives_each_ones(Comm& comm) {
  for (int turn = 0; turn < 7; ++turn) {
    const auto all = comm.gather_all(bytes_of(comm.rank(), 9, size_of(comm.rank(), 0, turn)));
    CHECK_EQUAL(static_cast<int>(all.size()), comm.size());
    for (int k = 0; k < comm.size(); ++k) CHECK(all[k] == bytes_of(k, 9, size_of(k, 0, turn)));
  }
}

inline void exchange_gives_each_its_own(Comm& comm) {
  for (int turn = 0; turn < 14; ++turn)
    CHECK(is_incoming(comm, turn, comm.exchange(outgoing(comm, turn))));
  // Nothing at all, and nothing but to oneself.
  std::vector<Bytes> to(static_cast<size_t>(comm.size()));
  for (const Bytes& bytes : comm.exchange(to)) CHECK(bytes.empty());
  to[comm.rank()] = {'o', 'w', 'n'};
  const auto from = comm.exchange(to);
  for (int k = 0; k < comm.size(); ++k) CHECK_EQUAL(from[k].empty(), k != comm.rank());
  CHECK((from[comm.rank()] == Bytes{'o', 'w', 'n'}));
}

// Other things may be told while messages are on their way, and ranks may be out of step.
inline void work_overlaps_an_exchange(Comm& comm) {
  for (int turn = 0; turn < 5; ++turn) {
    comm.start_exchange(outgoing(comm, turn));
    if (turn % comm.size() == comm.rank())
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    uint64_t one = 1;
    comm.add_up({&one, 1});
    CHECK_EQUAL(one, static_cast<uint64_t>(comm.size()));
    CHECK(comm.all_go_on());
    CHECK(is_incoming(comm, turn, comm.finish_exchange()));
  }
}

inline void add_up_is_exact(Comm& comm) {
  std::vector<uint64_t> values(1000);
  for (size_t k = 0; k < values.size(); ++k)
    values[k] = (uint64_t{1} << (k % 60)) + static_cast<uint64_t>(comm.rank());
  comm.add_up(values);
  const auto ranks = static_cast<uint64_t>(comm.size());
  for (size_t k = 0; k < values.size(); ++k)
    CHECK_EQUAL(values[k], ranks * (uint64_t{1} << (k % 60)) + ranks * (ranks - 1) / 2);
  comm.add_up({});
}

inline void all_go_on_unless_one_does_not(Comm& comm) {
  CHECK(comm.all_go_on());
  for (int k = 0; k < comm.size(); ++k) {
    CHECK(!comm.all_go_on(comm.rank() != k));
    CHECK(comm.all_go_on());
  }
  CHECK(!comm.all_go_on(false));
}

// The others see it in the midst of their work, and it is forgotten when they have agreed.
inline void what_is_raised_is_seen_and_forgotten(Comm& comm) {
  CHECK(!comm.raised());
  CHECK(comm.all_go_on());
  for (int k = 0; k < comm.size(); ++k) {
    if (comm.rank() == k) {
      comm.raise();
      comm.raise();  // says it once
    } else {
      while (!comm.raised()) std::this_thread::yield();
      CHECK(comm.raised());
    }
    CHECK(comm.all_go_on());
    // Nobody raises before all have looked.
    CHECK(!comm.raised());
    CHECK(comm.all_go_on());
  }
  // All at once, again and again, with nothing between: none is lost, none is left over.
  for (int turn = 0; turn < 200; ++turn) {
    if ((turn + comm.rank()) % 3 != 0) comm.raise();
    CHECK(comm.all_go_on());
  }
  CHECK(comm.all_go_on());
  CHECK(!comm.raised());
  CHECK(comm.all_go_on());
}

// ---- failing

// Throws what fail_all of some rank says, as an AgreedError.
template <class Call>
void check_agreed(const Call& call, Status status, const std::string& message) {
  try {
    call();
  } catch (const hrad::AgreedError& error) {
    if (error.status() != status || error.what() != message)
      hrad_test::failed(__FILE__, __LINE__, "another failure: " + std::string(error.what()));
    return;
  }
  hrad_test::failed(__FILE__, __LINE__, "nothing failed, wanted: " + message);
}

inline void all_is_well(Comm& comm) {
  CHECK(comm.all_go_on());
  CHECK(!comm.raised());
  CHECK(comm.all_go_on());
  CHECK(is_incoming(comm, 4, comm.exchange(outgoing(comm, 4))));
}

// Each rank in turn fails in place of this call of the others, and they can work together again.
template <class Call>
void each_fails_in_place_of(Comm& comm, const Call& call) {
  for (int k = 0; k < comm.size(); ++k) {
    const std::string message = "rank " + std::to_string(k) + " found no way";
    check_agreed(
        [&] {
          if (comm.rank() == k) comm.fail_all(Status::scene, message.c_str());
          call();
        },
        Status::scene, message);
    all_is_well(comm);
  }
}

inline void one_fails_in_place_of_any_call(Comm& comm) {
  each_fails_in_place_of(comm, [&] { comm.all_go_on(); });
  each_fails_in_place_of(comm, [&] {
    Bytes data = {'x'};
    comm.broadcast(data);
  });
  each_fails_in_place_of(comm, [&] { comm.gather_all({'x'}); });
  each_fails_in_place_of(comm, [&] { comm.start_exchange(outgoing(comm, 1)); });
  each_fails_in_place_of(comm, [&] {
    uint64_t one = 1;
    comm.add_up({&one, 1});
  });
}

// Messages under way, also large ones, are taken in.
inline void one_fails_between_start_and_finish(Comm& comm) {
  for (int turn = 0; turn < 4; ++turn)
    for (int k = 0; k < comm.size(); ++k) {
      comm.start_exchange(outgoing(comm, turn));
      check_agreed(
          [&] {
            if (comm.rank() == k) comm.fail_all(Status::memory, "no room");
            if (turn % 2 == 0) comm.finish_exchange();
            comm.all_go_on();
          },
          Status::memory, "no room");
      all_is_well(comm);
    }
}

inline void the_lowest_of_several_is_heard(Comm& comm) {
  const int lowest = comm.size() / 2;
  check_agreed(
      [&] {
        const std::string message = "from rank " + std::to_string(comm.rank());
        if (comm.rank() >= lowest)
          comm.fail_all(comm.rank() == lowest ? Status::file : Status::state, message.c_str());
        comm.gather_all({});
      },
      Status::file, "from rank " + std::to_string(lowest));
  all_is_well(comm);
  // Without a message; and of ordinary length.
  check_agreed([&] { comm.fail_all(Status::argument, ""); }, Status::argument, "");
  const std::string long_text(5000, 'w');
  check_agreed([&] { comm.fail_all(Status::argument, long_text.c_str()); }, Status::argument,
               long_text);
  all_is_well(comm);
}

// Who has raised and then fails, or fails while others raise, leaves nothing behind.
inline void raising_and_failing_go_together(Comm& comm) {
  for (int turn = 0; turn < 20; ++turn) {
    const int k = turn % comm.size();
    if (turn % 2 == 0) comm.raise();
    check_agreed(
        [&] {
          if (comm.rank() == k) comm.fail_all(Status::internal, "raised");
          comm.raise();
          comm.all_go_on();
        },
        Status::internal, "raised");
    all_is_well(comm);
  }
}

// The tests of one kind of Comm: OVER(body) is a cmocka test that runs body(comm) on all its ranks.
#define COMM_CONTRACT(OVER)                                                                 \
  OVER(comm_contract::ranks_are_in_order), OVER(comm_contract::broadcast_gives_rank_0s),    \
      OVER(comm_contract::gather_all_gives_each_ones),                                      \
      OVER(comm_contract::exchange_gives_each_its_own),                                     \
      OVER(comm_contract::work_overlaps_an_exchange), OVER(comm_contract::add_up_is_exact), \
      OVER(comm_contract::all_go_on_unless_one_does_not),                                   \
      OVER(comm_contract::what_is_raised_is_seen_and_forgotten),                            \
      OVER(comm_contract::one_fails_in_place_of_any_call),                                  \
      OVER(comm_contract::one_fails_between_start_and_finish),                              \
      OVER(comm_contract::the_lowest_of_several_is_heard),                                  \
      OVER(comm_contract::raising_and_failing_go_together)

}  // namespace comm_contract
