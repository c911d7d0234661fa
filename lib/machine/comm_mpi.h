// Processes that MPI started, over duplicates of a communicator of the program's own: its messages
// and its error handler stay untouched. No exception but hrad::Error and what the standard library
// throws, and nothing of the library `hrad` but inline functions, since a shared one shows no
// other. Floor 2 (machine).
#pragma once

#ifndef OMPI_SKIP_MPICXX
#define OMPI_SKIP_MPICXX 1  // the C++ bindings of old, which nobody needs
#endif
#ifndef MPICH_SKIP_MPICXX
#define MPICH_SKIP_MPICXX 1
#endif
#include <mpi.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "machine/comm.h"

namespace hrad {

// Error (mpi) unless this thread may call MPI now: a function of MPI that is called too early or
// too late ends the program.
void require_mpi();

std::string text_of_mpi_error(int code);

class CommMpi final : public Comm {
 public:
  // No message has a count that an int can't hold.
  static constexpr int64_t kMostBytesAtOnce = int64_t{1} << 30;

  // Collective over host, which is duplicated. Error: argument for MPI_COMM_NULL or an
  // intercommunicator, mpi.
  explicit CommMpi(MPI_Comm host, int64_t most_bytes_at_once = kMostBytesAtOnce);
  // Collective. After MPI_Finalize it does nothing.
  ~CommMpi() override;
  CommMpi(const CommMpi&) = delete;
  CommMpi& operator=(const CommMpi&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  std::unique_ptr<FilePart> open_part(const std::string& name, const std::string& path) override;
  int node() const override { return node_; }               // the lowest rank there
  bool threads_ok() const override { return threads_ok_; }  // from MPI_THREAD_FUNNELED on

 protected:
  std::vector<Word> do_tell(const Word& mine) override;
  void do_broadcast(Bytes& data, int root) override;
  std::vector<Bytes> do_gather_all(const Bytes& mine) override;
  void do_start_exchange(std::vector<Bytes> to) override;
  std::vector<Bytes> do_finish_exchange() override;
  void do_add_up(Span<uint64_t> values) override;
  void do_raise() override;
  bool do_raised() override;
  void do_settle(int others_raised) override;

 private:
  void check(int code, const char* function);
  void make_room(const std::function<void()>& body, const char* what);
  void broadcast_bytes(char* data, int64_t size, int root);
  template <class Start>
  void in_pieces(int64_t size, const Start& start);
  void wait_for_all(std::vector<MPI_Request>& requests, const char* function);
  void settle_the_rest();
  void free_communicators();

  const int64_t most_bytes_at_once_;
  MPI_Comm data_ = MPI_COMM_NULL;     // collective functions and exchanges
  MPI_Comm signals_ = MPI_COMM_NULL;  // what is raised, which may come at any time
  int rank_ = 0, size_ = 1, node_ = 0;
  bool threads_ok_ = true;
  bool has_raised_since_ = false;       // the last agreement
  bool broken_ = false;                 // MPI has failed: nothing can be agreed any more
  std::vector<Bytes> sent_, received_;  // by the exchange under way
  std::vector<MPI_Request> under_way_, raising_;
};

}  // namespace hrad
