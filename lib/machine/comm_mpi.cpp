// Collective functions, exchanges and signals over MPI (comm_mpi.h). Floor 2 (machine).
#include "machine/comm_mpi.h"

#include <algorithm>
#include <climits>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "machine/file_mpi.h"

namespace hrad {
namespace {

constexpr int kExchangeTag = 1, kSignalTag = 2;
// Beyond it every rank sends to all in its turn, straight from and to where the bytes belong.
constexpr int64_t kMostGatheredAtOnce = int64_t{1} << 20;  // bytes, of all ranks together
constexpr int64_t kMostAddedAtOnce = int64_t{1} << 24;     // numbers

[[noreturn]] void fail_mpi(const std::string& message) { throw Error(Status::mpi, message); }

}  // namespace

std::string text_of_mpi_error(int code) {
  char text[MPI_MAX_ERROR_STRING + 1] = "";
  int length = 0;
  if (MPI_Error_string(code, text, &length) != MPI_SUCCESS || length <= 0)
    return "error " + std::to_string(code);
  return std::string(text, static_cast<size_t>(length));
}

void require_mpi() {
  int yes = 0;
  MPI_Initialized(&yes);
  if (!yes) fail_mpi("MPI has not been started: call MPI_Init_thread before hrad_create_mpi");
  MPI_Finalized(&yes);
  if (yes) fail_mpi("MPI has ended: call hrad_create_mpi before MPI_Finalize");
  int level = MPI_THREAD_SINGLE;
  MPI_Query_thread(&level);
  if (level >= MPI_THREAD_SERIALIZED) return;
  MPI_Is_thread_main(&yes);
  if (!yes)
    fail_mpi(
        "this thread may not call MPI: use the solver on the thread that called MPI_Init_thread, "
        "or "
        "ask that function for MPI_THREAD_SERIALIZED");
}

void CommMpi::check(int code, const char* function) {
  if (code == MPI_SUCCESS) return;
  broken_ = true;
  fail_mpi(std::string(function) + " failed: " + text_of_mpi_error(code));
}

CommMpi::CommMpi(MPI_Comm host, int64_t most_bytes_at_once)
    : most_bytes_at_once_(most_bytes_at_once) {
  require_mpi();
  if (host == MPI_COMM_NULL)
    throw Error(Status::argument,
                "the communicator is MPI_COMM_NULL: this process does not belong to it and should "
                "not make a solver over it");
  int level = MPI_THREAD_SINGLE, between_groups = 0;
  MPI_Query_thread(&level);
  threads_ok_ = level >= MPI_THREAD_FUNNELED;
  check(MPI_Comm_test_inter(host, &between_groups), "MPI_Comm_test_inter");
  if (between_groups)
    throw Error(Status::argument,
                "the communicator is an intercommunicator: merge it by MPI_Intercomm_merge");
  try {
    check(MPI_Comm_dup(host, &data_), "MPI_Comm_dup");
    check(MPI_Comm_set_errhandler(data_, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
    check(MPI_Comm_dup(data_, &signals_), "MPI_Comm_dup");
    check(MPI_Comm_set_errhandler(signals_, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
    check(MPI_Comm_rank(data_, &rank_), "MPI_Comm_rank");
    check(MPI_Comm_size(data_, &size_), "MPI_Comm_size");
    MPI_Comm local = MPI_COMM_NULL;
    check(MPI_Comm_split_type(data_, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &local),
          "MPI_Comm_split_type");
    node_ = rank_;
    const int code = MPI_Bcast(&node_, 1, MPI_INT, 0, local);
    MPI_Comm_free(&local);
    check(code, "MPI_Bcast");
  } catch (...) {
    free_communicators();
    throw;
  }
}

CommMpi::~CommMpi() {
  int ended = 0;
  MPI_Finalized(&ended);
  if (ended) return;
  try {
    if (!broken_) settle_the_rest();
  } catch (...) {  // as well as could be
  }
  free_communicators();
}

// Collective: what was raised since the last agreement is still on its way.
void CommMpi::settle_the_rest() {
  Word word;
  word.raised = has_raised_since_ ? 1 : 0;
  const std::vector<Word> words = do_tell(word);
  int others_raised = 0;
  for (int k = 0; k < size_; ++k)
    if (k != rank_) others_raised += words[static_cast<size_t>(k)].raised;
  do_settle(others_raised);
}

void CommMpi::free_communicators() {
  for (MPI_Comm* comm : {&signals_, &data_})
    if (*comm != MPI_COMM_NULL) MPI_Comm_free(comm);
}

// Calls start(first, count) for pieces that MPI can count.
template <class Start>
void CommMpi::in_pieces(int64_t size, const Start& start) {
  for (int64_t first = 0; first < size; first += most_bytes_at_once_)
    start(first, static_cast<int>(std::min(most_bytes_at_once_, size - first)));
}

void CommMpi::wait_for_all(std::vector<MPI_Request>& requests, const char* function) {
  const int code =
      MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  requests.clear();
  check(code, function);
}

// Collective: the memory for what is about to come. Where one rank has none, all fail the same,
// before any of them sends what would not be received.
void CommMpi::make_room(const std::function<void()>& body, const char* what) {
  int short_of_memory = size_;  // the lowest such rank
  try {
    body();
  } catch (const std::bad_alloc&) {
    short_of_memory = rank_;
  } catch (const std::length_error&) {
    short_of_memory = rank_;
  }
  check(MPI_Allreduce(MPI_IN_PLACE, &short_of_memory, 1, MPI_INT, MPI_MIN, data_), "MPI_Allreduce");
  if (short_of_memory < size_)
    throw AgreedError(Status::memory, "out of memory on rank " + std::to_string(short_of_memory) +
                                          ", for " + what +
                                          ": use more nodes, or a larger accuracy or min_area");
}

std::vector<Comm::Word> CommMpi::do_tell(const Word& mine) {
  constexpr int numbers = sizeof(Word) / sizeof(int32_t);
  static_assert(numbers == 3 && sizeof(Word) == 3 * sizeof(int32_t), "a word is sent as it lies");
  std::vector<Word> words(static_cast<size_t>(size_));
  check(MPI_Allgather(&mine, numbers, MPI_INT32_T, words.data(), numbers, MPI_INT32_T, data_),
        "MPI_Allgather");
  has_raised_since_ = false;
  return words;
}

void CommMpi::broadcast_bytes(char* data, int64_t size, int root) {
  in_pieces(size, [&](int64_t first, int count) {
    check(MPI_Bcast(data + first, count, MPI_BYTE, root, data_), "MPI_Bcast");
  });
}

void CommMpi::do_broadcast(Bytes& data, int root) {
  auto size = static_cast<int64_t>(data.size());
  check(MPI_Bcast(&size, 1, MPI_INT64_T, root, data_), "MPI_Bcast");
  make_room([&] { data.resize(static_cast<size_t>(size)); }, "what another rank tells all");
  broadcast_bytes(data.data(), size, root);
}

std::vector<Bytes> CommMpi::do_gather_all(const Bytes& mine) {
  const auto own_size = static_cast<int64_t>(mine.size());
  std::vector<int64_t> sizes(static_cast<size_t>(size_));
  check(MPI_Allgather(&own_size, 1, MPI_INT64_T, sizes.data(), 1, MPI_INT64_T, data_),
        "MPI_Allgather");
  int64_t total = 0;
  for (int64_t size : sizes) total += size;
  const bool at_once = total <= std::min(kMostGatheredAtOnce, most_bytes_at_once_);
  std::vector<Bytes> all(sizes.size());
  Bytes together;
  std::vector<int> counts, places;
  make_room(
      [&] {
        for (size_t k = 0; k < sizes.size(); ++k) all[k].resize(static_cast<size_t>(sizes[k]));
        if (at_once) {
          together.resize(static_cast<size_t>(total));
          counts.assign(sizes.begin(), sizes.end());
          places.assign(sizes.size(), 0);
        }
      },
      "what all ranks tell each other");
  if (at_once) {
    for (size_t k = 1; k < sizes.size(); ++k) places[k] = places[k - 1] + counts[k - 1];
    check(MPI_Allgatherv(mine.data(), static_cast<int>(own_size), MPI_BYTE, together.data(),
                         counts.data(), places.data(), MPI_BYTE, data_),
          "MPI_Allgatherv");
    for (size_t k = 0; k < sizes.size(); ++k)
      std::copy_n(together.begin() + places[k], counts[k], all[k].begin());
    return all;
  }
  all[static_cast<size_t>(rank_)] = mine;
  for (int k = 0; k < size_; ++k)
    broadcast_bytes(all[static_cast<size_t>(k)].data(), sizes[static_cast<size_t>(k)], k);
  return all;
}

// Receives are begun before anything is sent, so that large messages flow at once.
void CommMpi::do_start_exchange(std::vector<Bytes> to) {
  const auto ranks = static_cast<size_t>(size_);
  std::vector<int64_t> to_sizes(ranks), from_sizes(ranks);
  for (size_t k = 0; k < ranks; ++k) to_sizes[k] = static_cast<int64_t>(to[k].size());
  check(MPI_Alltoall(to_sizes.data(), 1, MPI_INT64_T, from_sizes.data(), 1, MPI_INT64_T, data_),
        "MPI_Alltoall");
  sent_ = std::move(to);
  make_room(
      [&] {
        received_.assign(ranks, {});
        int64_t pieces = 0;
        for (int k = 0; k < size_; ++k) {
          if (k == rank_) continue;
          received_[k].resize(static_cast<size_t>(from_sizes[k]));
          in_pieces(from_sizes[k], [&](int64_t, int) { ++pieces; });
          in_pieces(to_sizes[k], [&](int64_t, int) { ++pieces; });
        }
        under_way_.reserve(static_cast<size_t>(pieces));
      },
      "the messages of other ranks");
  const auto begin = [&](auto function, const char* name, std::vector<Bytes>& all) {
    for (int step = 1; step < size_; ++step) {
      const int other = (rank_ + step) % size_;  // not all to the same one at first
      Bytes& bytes = all[static_cast<size_t>(other)];
      in_pieces(static_cast<int64_t>(bytes.size()), [&](int64_t first, int count) {
        MPI_Request request = MPI_REQUEST_NULL;
        check(function(bytes.data() + first, count, MPI_BYTE, other, kExchangeTag, data_, &request),
              name);
        under_way_.push_back(request);
      });
    }
  };
  begin(MPI_Irecv, "MPI_Irecv", received_);
  begin(MPI_Isend, "MPI_Isend", sent_);
  received_[static_cast<size_t>(rank_)] = std::move(sent_[static_cast<size_t>(rank_)]);
}

std::vector<Bytes> CommMpi::do_finish_exchange() {
  wait_for_all(under_way_, "MPI_Waitall, in an exchange,");
  sent_.clear();
  return std::exchange(received_, {});
}

void CommMpi::do_add_up(Span<uint64_t> values) {
  const auto size = static_cast<int64_t>(values.size());
  for (int64_t first = 0; first < size; first += kMostAddedAtOnce)
    check(MPI_Allreduce(MPI_IN_PLACE, values.data() + first,
                        static_cast<int>(std::min(kMostAddedAtOnce, size - first)), MPI_UINT64_T,
                        MPI_SUM, data_),
          "MPI_Allreduce");
}

std::unique_ptr<FilePart> CommMpi::open_part(const std::string& name, const std::string& path) {
  if (!is_name_for_mpi(name)) return nullptr;
  return std::make_unique<FilePartMpi>(name, path, most_bytes_at_once_);
}

// A message of no bytes to everyone. do_settle of the next agreement sees that it has gone.
void CommMpi::do_raise() {
  has_raised_since_ = true;
  for (int step = 1; step < size_; ++step) {
    MPI_Request request = MPI_REQUEST_NULL;
    check(MPI_Isend(nullptr, 0, MPI_BYTE, (rank_ + step) % size_, kSignalTag, signals_, &request),
          "MPI_Isend");
    raising_.push_back(request);
  }
}

bool CommMpi::do_raised() {
  int there = 0;
  check(MPI_Iprobe(MPI_ANY_SOURCE, kSignalTag, signals_, &there, MPI_STATUS_IGNORE), "MPI_Iprobe");
  return there != 0;
}

// Who was fast may have raised again meanwhile. One message is like another, so that those left are
// as many as were raised since.
void CommMpi::do_settle(int others_raised) {
  for (int k = 0; k < others_raised; ++k)
    check(MPI_Recv(nullptr, 0, MPI_BYTE, MPI_ANY_SOURCE, kSignalTag, signals_, MPI_STATUS_IGNORE),
          "MPI_Recv");
  wait_for_all(raising_, "MPI_Waitall, of what was raised,");
}

}  // namespace hrad
