// The contract of SharedFile over MPI, on however many ranks mpirun starts, also in pieces of a few
// bytes; what the system refuses to write on one rank; and the program's ways with files of its
// own, which stay what they are.
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "api/guard.h"
#include "machine/comm_mpi.h"
#include "machine/file_mpi.h"
#include "machine/shared_file_contract.h"
#include "mpi_program.h"

namespace {

using namespace shared_file_contract;

// The same on all ranks, and gone when the test is.
class Folder {
 public:
  explicit Folder(Comm& comm) : comm_(comm) {
    if (comm.rank() == 0) {
      char name[] = "/tmp/hrad_test_mpi_XXXXXX";
      CHECK(mkdtemp(name) != nullptr);
      path.assign(name, name + sizeof name - 1);
    }
    comm.broadcast(path);
  }
  ~Folder() {
    comm_.all_go_on();
    if (comm_.rank() == 0) std::filesystem::remove_all(name());
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string name() const { return {path.begin(), path.end()}; }

 private:
  Comm& comm_;
  hrad::Bytes path;
};

template <void (*body)(Comm&, const std::string&)>
void over_mpi() {
  hrad::CommMpi comm(MPI_COMM_WORLD);
  const Folder folder(comm);
  body(comm, folder.name());
}

// What more than 2 GiB take, with less disk.
template <void (*body)(Comm&, const std::string&)>
void in_pieces() {
  hrad::CommMpi comm(MPI_COMM_WORLD, 40961);
  const Folder folder(comm);
  body(comm, folder.name());
}

void files_go_through_mpi() {
  hrad::CommMpi comm(MPI_COMM_WORLD);
  const Folder folder(comm);
  if (comm.rank() == 0) std::ofstream(folder.name() + "/a") << "text";
  comm.all_go_on();
  const auto part = comm.open_part(folder.name() + "/a", "the path");
  CHECK(dynamic_cast<hrad::FilePartMpi*>(part.get()) != nullptr);
  char text[5] = "";
  CHECK(part->read_start(text, 4) && std::string(text) == "text");
  CHECK(!part->read_start(text, 5));
  // Names that not every MPI takes as they are.
  CHECK(!comm.open_part("/a:b", "the path"));
  CHECK(!comm.open_part("/" + std::string(230, 'a'), "the path"));
}

// A file can't be opened, whatever the program wants MPI to do then; and what it wanted stays.
int errors_met = 0;
void note_error(MPI_File*, int*, ...) { ++errors_met; }

void what_can_not_be_opened() {
  hrad::CommMpi comm(MPI_COMM_WORLD);
  MPI_Errhandler own, before, found;
  MPI_File_get_errhandler(MPI_FILE_NULL, &before);
  MPI_File_create_errhandler(note_error, &own);
  MPI_File_set_errhandler(MPI_FILE_NULL, own);
  CHECK_FAILS(comm.open_part("/no/such/file", "the path"), hrad::Status::file,
              "the path: cannot open: ");
  CHECK_EQUAL(errors_met, 0);
  MPI_File_get_errhandler(MPI_FILE_NULL, &found);
  CHECK(found == own);
  MPI_File_set_errhandler(MPI_FILE_NULL, before);
  for (MPI_Errhandler* handler : {&own, &before, &found}) MPI_Errhandler_free(handler);
}

// A limit on the size of files, on one rank alone: all say the same, and the old file stays.
void one_rank_may_not_write() {
  hrad::CommMpi comm(MPI_COMM_WORLD);
  const Folder folder(comm);
  const std::string path = folder.name() + "/a";
  std::signal(SIGXFSZ, SIG_IGN);
  for (int limited = 0; limited < comm.size(); ++limited) {
    if (comm.rank() == 0) std::ofstream(path) << "old";
    comm.all_go_on();
    rlimit before, narrow;
    CHECK_EQUAL(getrlimit(RLIMIT_FSIZE, &before), 0);
    narrow = before;
    narrow.rlim_cur = 100000;
    if (comm.rank() == limited) CHECK_EQUAL(setrlimit(RLIMIT_FSIZE, &narrow), 0);
    std::string message;
    try {
      hrad::api::agreed(comm, [&] { write_new(comm, path); });
    } catch (const hrad::Error& error) {
      message = error.what();
    }
    CHECK_EQUAL(setrlimit(RLIMIT_FSIZE, &before), 0);
    hrad::Bytes same(message.begin(), message.end());
    comm.broadcast(same);
    CHECK(message == std::string(same.begin(), same.end()));
    CHECK(message.find(path + ": cannot write: ") == 0);
    CHECK(message.find("File too large") != std::string::npos);
    CHECK(content(path) == "old");
    CHECK_EQUAL(entries(folder.name()), int64_t{1});
    comm.all_go_on();
  }
}

}  // namespace

int main(int argc, char** argv) {
  int level = MPI_THREAD_SINGLE;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  const CMUnitTest tests[] = {
      HRAD_TEST(over_mpi<all_write_their_pieces>),
      HRAD_TEST(in_pieces<all_write_their_pieces>),
      HRAD_TEST(over_mpi<modes_and_names>),
      HRAD_TEST(over_mpi<abandoned_by_all>),
      HRAD_TEST(files_go_through_mpi),
      HRAD_TEST(what_can_not_be_opened),
      HRAD_TEST(one_rank_may_not_write),
  };
  run_together(tests, sizeof tests / sizeof *tests);
  MPI_Finalize();
  return 0;
}
