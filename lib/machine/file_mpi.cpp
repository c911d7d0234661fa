// MPI_File_open and what follows. What a function returns is not enough: Open MPI 4 calls it a
// success that nothing was written to a full disk, so that bytes are counted; what the system has
// said is told where it is known. Floor 2 (machine).
#include "machine/file_mpi.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "base/error.h"

namespace hrad {
namespace {

// While it lives, a file that can't be opened is the caller's to deal with, whatever the program
// has asked of MPI.
class OpeningReturns {
 public:
  OpeningReturns() {
    MPI_File_get_errhandler(MPI_FILE_NULL, &before_);
    is_usual_ = before_ == MPI_ERRORS_RETURN;
    if (!is_usual_) MPI_File_set_errhandler(MPI_FILE_NULL, MPI_ERRORS_RETURN);
  }
  ~OpeningReturns() {
    if (!is_usual_) MPI_File_set_errhandler(MPI_FILE_NULL, before_);
    MPI_Errhandler_free(&before_);
  }
  OpeningReturns(const OpeningReturns&) = delete;
  OpeningReturns& operator=(const OpeningReturns&) = delete;

 private:
  MPI_Errhandler before_ = MPI_ERRHANDLER_NULL;
  bool is_usual_ = false;
};

constexpr size_t kLongestName = 200;

}  // namespace

bool is_name_for_mpi(const std::string& name) {
  return name.size() <= kLongestName && name.find(':') == std::string::npos;
}

FilePartMpi::FilePartMpi(const std::string& name, std::string path, int64_t most_bytes_at_once)
    : path_(std::move(path)), most_bytes_at_once_(most_bytes_at_once) {
  const OpeningReturns returns;
  const int code = MPI_File_open(MPI_COMM_SELF, name.c_str(), MPI_MODE_RDWR, MPI_INFO_NULL, &file_);
  if (code != MPI_SUCCESS) {
    file_ = MPI_FILE_NULL;
    fail_here("open", code, 0);  // of several system calls the last one may have failed for less
  }
  MPI_File_set_errhandler(file_, MPI_ERRORS_RETURN);
}

FilePartMpi::~FilePartMpi() {
  if (file_ != MPI_FILE_NULL) MPI_File_close(&file_);
}

void FilePartMpi::fail_here(const char* step, int code, int system_error) const {
  std::string why = system_error ? std::strerror(system_error) : "";
  if (code != MPI_SUCCESS) why += (why.empty() ? "" : ", ") + text_of_mpi_error(code);
  if (why.empty()) why = "MPI has written too few bytes";
  throw Error(Status::file, path_ + ": cannot " + step + ": " + why);
}

void FilePartMpi::write_at(uint64_t offset, const char* data, size_t size) {
  while (size > 0) {
    const int wanted =
        static_cast<int>(std::min<uint64_t>(size, static_cast<uint64_t>(most_bytes_at_once_)));
    int count = 0;
    MPI_Status status;
    errno = 0;
    const int code =
        MPI_File_write_at(file_, static_cast<MPI_Offset>(offset), data, wanted, MPI_BYTE, &status);
    const int system_error = errno;
    if (code == MPI_SUCCESS) MPI_Get_count(&status, MPI_BYTE, &count);
    if (code == MPI_SUCCESS && count <= 0 && system_error == EINTR) continue;
    if (code != MPI_SUCCESS || count <= 0 || count > wanted) fail_here("write", code, system_error);
    data += count;
    size -= static_cast<size_t>(count);
    offset += static_cast<uint64_t>(count);
  }
}

bool FilePartMpi::read_start(char* data, size_t size) {
  int count = 0;
  MPI_Status status;
  errno = 0;
  const int code = MPI_File_read_at(file_, 0, data, static_cast<int>(size), MPI_BYTE, &status);
  if (code != MPI_SUCCESS) fail_here("read", code, errno);
  MPI_Get_count(&status, MPI_BYTE, &count);
  return count == static_cast<int>(size);
}

void FilePartMpi::finish() {
  errno = 0;
  int code = MPI_File_sync(file_);
  const int system_error = errno;
  // Some file systems have nothing to synchronise and say EINVAL.
  if (code != MPI_SUCCESS && system_error != EINVAL) fail_here("write", code, system_error);
  MPI_File file = std::exchange(file_, MPI_FILE_NULL);
  code = MPI_File_close(&file);
  if (code != MPI_SUCCESS) fail_here("write", code, 0);
}

}  // namespace hrad
