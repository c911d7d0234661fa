// What a SharedFile promises (machine/shared_file.h), told as functions that all ranks run: tests
// call them over one process, over threads and over MPI. The folder is the same on all.
#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "machine/shared_file.h"
#include "support/check.h"

namespace shared_file_contract {

using hrad::Comm;
using hrad::SharedFile;

inline std::string content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline int64_t entries(const std::string& folder) {
  return std::distance(std::filesystem::directory_iterator(folder),
                       std::filesystem::directory_iterator());
}

// Pieces of some sizes, one rank's behind the other's.
inline size_t size_of_piece(int k) {
  constexpr size_t sizes[] = {1, 100, 0, 70000, 3, 1 << 20, 4096};
  return sizes[static_cast<size_t>(k) % 7];
}
inline std::string piece(int k) {
  return std::string(size_of_piece(k), static_cast<char>('a' + k % 26));
}

constexpr int pieces = 25;

inline std::string wanted_content() {
  std::string wanted;
  for (int k = 0; k < pieces; ++k) wanted += piece(k);
  return wanted;
}

// The last piece first, as a head is written that is known at the end alone.
inline void write_pieces(Comm& comm, SharedFile& file) {
  const std::string all = wanted_content();
  uint64_t end = all.size();
  for (int k = pieces - 1; k >= 0; --k) {
    end -= size_of_piece(k);
    if (k % comm.size() == comm.rank()) file.write_at(end, all.data() + end, size_of_piece(k));
  }
}

inline void write_new(Comm& comm, const std::string& path, int older = 0) {
  SharedFile file(comm, path);
  write_pieces(comm, file);
  file.commit_keeping(older);
}

// Each of these is called with the ranks side by side, and checks when all are done with the file.
inline void all_write_their_pieces(Comm& comm, const std::string& folder) {
  const std::string path = folder + "/a";
  write_new(comm, path);
  comm.all_go_on();
  CHECK(content(path) == wanted_content());
  CHECK_EQUAL(entries(folder), int64_t{1});
  comm.all_go_on();
  if (comm.rank() == 0) std::ofstream(path) << "old";
  comm.all_go_on();
  write_new(comm, path, 1);
  comm.all_go_on();
  CHECK(content(path) == wanted_content());
  CHECK(content(path + ".prev") == "old");
  CHECK_EQUAL(entries(folder), int64_t{2});
  comm.all_go_on();
}

// Not the mode nor the name of what is replaced keeps the others out.
inline void modes_and_names(Comm& comm, const std::string& folder) {
  const std::string path =
      folder + "/colon: " + std::string(150, 'n') + "/" + std::string(150, 'm');
  if (comm.rank() == 0) {
    std::filesystem::create_directory(std::filesystem::path(path).parent_path());
    std::ofstream(path) << "old";
    CHECK(chmod(path.c_str(), 0400) == 0);
    CHECK(symlink(path.c_str(), (folder + "/link").c_str()) == 0);
  }
  comm.all_go_on();
  // Rank 0's path counts.
  write_new(comm, comm.rank() == 0 ? folder + "/link" : "elsewhere");
  comm.all_go_on();
  CHECK(content(path) == wanted_content());
  struct stat status;
  CHECK(lstat(path.c_str(), &status) == 0);
  CHECK_EQUAL(status.st_mode & 07777, 0400u);
  comm.all_go_on();
}

inline void abandoned_by_all(Comm& comm, const std::string& folder) {
  const std::string path = folder + "/a";
  if (comm.rank() == 0) std::ofstream(path) << "old";
  comm.all_go_on();
  {
    SharedFile file(comm, path);
    write_pieces(comm, file);
  }
  comm.all_go_on();
  CHECK(content(path) == "old");
  CHECK_EQUAL(entries(folder), int64_t{1});
  comm.all_go_on();
}

}  // namespace shared_file_contract
