// The contract of Comm over MPI, on however many ranks mpirun starts: as it is, in pieces of a few
// bytes, and over half of the ranks.
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

#include "machine/comm_contract.h"
#include "machine/comm_mpi.h"
#include "mpi_program.h"
#include "support/sanitized.h"

namespace {

[[maybe_unused]] rlim_t used_address_space() {
  long long pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return static_cast<rlim_t>(pages * sysconf(_SC_PAGESIZE));
}

template <void (*body)(hrad::Comm&)>
void on_all(MPI_Comm host, int64_t most_bytes_at_once) {
  hrad::CommMpi comm(host, most_bytes_at_once);
  body(comm);
}

template <void (*body)(hrad::Comm&)>
void over_mpi() {
  on_all<body>(MPI_COMM_WORLD, hrad::CommMpi::kMostBytesAtOnce);
}

// What a message of more than 2 GiB takes, with less memory: many pieces, of odd sizes.
template <void (*body)(hrad::Comm&)>
void in_pieces() {
  on_all<body>(MPI_COMM_WORLD, 4093);
}

// Two groups of ranks beside each other, the second in reverse order.
template <void (*body)(hrad::Comm&)>
void over_halves() {
  const int rank = rank_of_world(), size = size_of_world();
  const int half = rank < size / 2 ? 0 : 1;
  MPI_Comm own = MPI_COMM_NULL;
  MPI_Comm_split(MPI_COMM_WORLD, half, half ? -rank : rank, &own);
  on_all<body>(own, hrad::CommMpi::kMostBytesAtOnce);
  MPI_Comm_free(&own);
}

// The program's messages and signals of two Comms don't mix, whatever is under way.
void what_runs_beside_stays_apart() {
  const int rank = rank_of_world(), size = size_of_world();
  const int right = (rank + 1) % size, left = (rank + size - 1) % size;
  int theirs = -1;
  MPI_Request request;
  MPI_Irecv(&theirs, 1, MPI_INT, MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &request);
  {
    hrad::CommMpi one(MPI_COMM_WORLD), other(MPI_COMM_WORLD);
    one.raise();
    one.start_exchange(comm_contract::outgoing(one, 2));
    CHECK(!other.raised());
    other.start_exchange(comm_contract::outgoing(other, 4));
    CHECK(comm_contract::is_incoming(one, 2, one.finish_exchange()));
    CHECK(comm_contract::is_incoming(other, 4, other.finish_exchange()));
    other.raise();  // and is never asked again
  }
  MPI_Send(&rank, 1, MPI_INT, right, 5, MPI_COMM_WORLD);
  MPI_Wait(&request, MPI_STATUS_IGNORE);
  CHECK_EQUAL(theirs, left);
}

// Where one rank has no room for what comes, all fail alike before it is sent, and go on without
// it. (The sanitizers' own memory makes a limit meaningless.)
void one_rank_is_short_of_memory() {
#if !HRAD_TEST_THREADS && !HRAD_TEST_ADDRESSES
  hrad::CommMpi comm(MPI_COMM_WORLD);
  if (comm.alone()) return;
  constexpr size_t much = size_t{64} << 20;
  const int last = comm.size() - 1;
  const std::string message = "out of memory on rank " + std::to_string(last);
  hrad::Bytes data(comm.rank() == 0 ? much : 0, 'd');
  std::vector<hrad::Bytes> to(static_cast<size_t>(comm.size()));
  to[static_cast<size_t>(last)] = data;
  rlimit before, narrow;
  CHECK_EQUAL(getrlimit(RLIMIT_AS, &before), 0);
  narrow = before;
  narrow.rlim_cur = used_address_space() + much / 4;
  if (comm.rank() == last) CHECK_EQUAL(setrlimit(RLIMIT_AS, &narrow), 0);
  CHECK_FAILS(comm.exchange(to), hrad::Status::memory, message);
  CHECK_FAILS(comm.gather_all(data), hrad::Status::memory, message);
  CHECK_FAILS(comm.broadcast(data), hrad::Status::memory, message);
  CHECK_EQUAL(setrlimit(RLIMIT_AS, &before), 0);
  comm_contract::all_is_well(comm);
  comm.broadcast(data);
  CHECK_EQUAL(data.size(), much);
#endif
}

void all_ranks_are_on_this_machine() {
  hrad::CommMpi comm(MPI_COMM_WORLD);
  CHECK_EQUAL(comm.size(), size_of_world());
  CHECK_EQUAL(comm.rank(), rank_of_world());
  CHECK_EQUAL(comm.node(), 0);  // mpirun without a host file
  CHECK(comm.threads_ok());
}

void what_is_no_group_of_ranks_is_refused() {
  CHECK_FAILS(hrad::CommMpi(MPI_COMM_NULL), hrad::Status::argument, "MPI_COMM_NULL");
  const int rank = rank_of_world(), size = size_of_world();
  if (size < 2) return;
  const int half = rank < size / 2 ? 0 : 1;
  MPI_Comm own = MPI_COMM_NULL, between = MPI_COMM_NULL;
  MPI_Comm_split(MPI_COMM_WORLD, half, rank, &own);
  MPI_Intercomm_create(own, 0, MPI_COMM_WORLD, half ? 0 : size / 2, 1, &between);
  CHECK_FAILS(hrad::CommMpi{between}, hrad::Status::argument, "MPI_Intercomm_merge");
  MPI_Comm_free(&between);
  MPI_Comm_free(&own);
}

}  // namespace

#define OVER_MPI(body) HRAD_TEST(over_mpi<body>)
#define IN_PIECES(body) HRAD_TEST(in_pieces<body>)
#define OVER_HALVES(body) HRAD_TEST(over_halves<body>)

int main(int argc, char** argv) {
  int level = MPI_THREAD_SINGLE;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  const CMUnitTest tests[] = {
      COMM_CONTRACT(OVER_MPI),
      COMM_CONTRACT(IN_PIECES),
      COMM_CONTRACT(OVER_HALVES),
      HRAD_TEST(what_runs_beside_stays_apart),
      HRAD_TEST(one_rank_is_short_of_memory),
      HRAD_TEST(all_ranks_are_on_this_machine),
      HRAD_TEST(what_is_no_group_of_ranks_is_refused),
  };
  run_together(tests, sizeof tests / sizeof *tests);
  MPI_Finalize();
  return 0;
}
