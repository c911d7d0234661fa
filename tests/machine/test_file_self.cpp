// Files written whole or not at all.
#include <dirent.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "base/error.h"
#include "machine/file_self.h"
#include "support/check.h"

using hrad::Status;
using hrad::WholeFile;

namespace {

// A folder that is gone at the end of the test.
struct Folder {
  std::string path;
  Folder() {
    char name[] = "/tmp/hrad_test_file_XXXXXX";
    CHECK(mkdtemp(name) != nullptr);
    path = name;
  }
  ~Folder() {
    if (std::system(("rm -rf '" + path + "'").c_str()) != 0) std::perror("rm");
  }
  int entries() const {
    DIR* folder = opendir(path.c_str());
    int count = 0;
    while (readdir(folder)) ++count;
    closedir(folder);
    return count - 2;
  }
};

std::string content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void put(const std::string& path, const std::string& text) {
  WholeFile file(path);
  file.text(text);
  file.commit();
}

void appears_only_when_committed() {
  Folder folder;
  const std::string path = folder.path + "/out";
  {
    WholeFile file(path);
    file.text("hello");
    CHECK(access(path.c_str(), F_OK) != 0);
    file.text(" world");
    file.commit();
    CHECK(content(path) == "hello world");
  }
  CHECK(content(path) == "hello world");
  CHECK_EQUAL(folder.entries(), 1);
}

void abandoned_file_leaves_the_old_one() {
  Folder folder;
  const std::string path = folder.path + "/out";
  put(path, "old");
  {
    WholeFile file(path);
    file.text(std::string(1 << 20, 'x'));
  }
  CHECK(content(path) == "old");
  CHECK_EQUAL(folder.entries(), 1);
}

void large_and_small_pieces_keep_their_order() {
  Folder folder;
  const std::string path = folder.path + "/out";
  std::string wanted;
  WholeFile file(path);
  for (int i = 0; i < 2000; ++i) {
    const std::string piece(static_cast<size_t>(i) * 7 % 1000, static_cast<char>('a' + i % 26));
    file.text(piece);
    wanted += piece;
    if (i % 500 == 0) {
      const std::string large(600000, static_cast<char>('A' + i % 26));
      file.text(large);
      wanted += large;
    }
  }
  file.commit();
  CHECK(content(path) == wanted);
}

void finished_is_not_committed() {
  Folder folder;
  const std::string path = folder.path + "/out";
  {
    WholeFile file(path);
    file.text("new");
    file.finish();
    CHECK(access(path.c_str(), F_OK) != 0);
  }
  CHECK_EQUAL(folder.entries(), 0);
  WholeFile file(path);
  file.text("new");
  file.finish();
  file.commit();
  CHECK(content(path) == "new");
}

void two_writers_in_one_process() {
  Folder folder;
  WholeFile a(folder.path + "/a"), b(folder.path + "/b");
  a.text("a");
  b.text("b");
  b.commit();
  a.commit();
  CHECK(content(folder.path + "/a") == "a");
  CHECK(content(folder.path + "/b") == "b");
}

void mode_and_links_are_kept() {
  Folder folder;
  const std::string path = folder.path + "/out", link = folder.path + "/link";
  put(path, "old");
  CHECK(chmod(path.c_str(), 0640) == 0);
  CHECK(symlink("out", link.c_str()) == 0);
  put(link, "new");
  CHECK(content(path) == "new");
  struct stat status;
  CHECK(lstat(link.c_str(), &status) == 0 && S_ISLNK(status.st_mode));
  CHECK(lstat(path.c_str(), &status) == 0);
  CHECK_EQUAL(status.st_mode & 07777, 0640u);
}

void the_longest_name_works() {
  Folder folder;
  const std::string path = folder.path + "/" + std::string(255, 'n');
  put(path, "x");
  CHECK(content(path) == "x");
}

void refused_targets() {
  Folder folder;
  CHECK_FAILS(WholeFile(""), Status::file, "cannot create");
  CHECK_FAILS(WholeFile(folder.path), Status::file,
              folder.path + ": cannot create: Is a directory");
  CHECK_FAILS(WholeFile(folder.path + "/new/"), Status::file, "Is a directory");
  CHECK_FAILS(WholeFile(folder.path + "/no/file"), Status::file, "No such file or directory");
  CHECK_FAILS(WholeFile("/dev/null"), Status::file, "not a regular file");
  CHECK(mkfifo((folder.path + "/fifo").c_str(), 0600) == 0);
  CHECK_FAILS(WholeFile(folder.path + "/fifo"), Status::file, "not a regular file");
  CHECK_EQUAL(folder.entries(), 1);
}

void failed_writes_leave_nothing() {
  Folder folder;
  const std::string path = folder.path + "/out";
  put(path, "old");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before;
  CHECK(getrlimit(RLIMIT_FSIZE, &before) == 0);
  rlimit small = before;
  small.rlim_cur = 1000;
  CHECK(setrlimit(RLIMIT_FSIZE, &small) == 0);
  const std::string wanted = path + ": cannot write: File too large";
  CHECK_FAILS(put(path, std::string(1001, 'x')), Status::file, wanted);
  CHECK_FAILS(put(path, std::string(1 << 20, 'x')), Status::file, wanted);
  CHECK(setrlimit(RLIMIT_FSIZE, &before) == 0);
  CHECK(content(path) == "old");
  CHECK_EQUAL(folder.entries(), 1);
}

// Whatever fails, the old content is under one of its names.
void what_can_not_be_kept_is_not_replaced() {
  Folder folder;
  const std::string path = folder.path + "/out", inside = path + ".prev/inside";
  put(path, "old");
  CHECK_EQUAL(::mkdir((path + ".prev").c_str(), 0700), 0);
  put(inside, "");
  {
    WholeFile file(path);
    file.text("new");
    bool failed = false;
    try {
      file.commit_keeping(1);
    } catch (const hrad::Error& error) {
      failed = error.status() == Status::file;
    }
    CHECK(failed);
  }
  CHECK(content(path) == "old");
  CHECK_EQUAL(folder.entries(), 2);
  ::unlink(inside.c_str());
  ::rmdir((path + ".prev").c_str());
}

// As by a writer that was killed between its last two renames: .prev and the file are one. A rename
// of one name of a file to another would do nothing, and the temporary name would stay.
void older_files_are_kept_after_a_writer_was_killed() {
  Folder folder;
  const std::string path = folder.path + "/out";
  put(path, "second");
  put(path + ".prev2", "first");
  CHECK_EQUAL(::link(path.c_str(), (path + ".prev").c_str()), 0);
  {
    WholeFile file(path);
    file.text("third");
    file.commit_keeping(2);
  }
  CHECK(content(path) == "third");
  CHECK(content(path + ".prev") == "second");
  CHECK(content(path + ".prev2") == "first");
  CHECK_EQUAL(folder.entries(), 3);
}

void reading() {
  Folder folder;
  const std::string path = folder.path + "/in";
  std::string text = "before";
  CHECK(!hrad::read_file(path, text));
  CHECK(!hrad::read_file("", text));
  const std::string wanted = std::string(300000, 'x') + std::string(1, '\0') + "end";
  put(path, wanted);
  CHECK(hrad::read_file(path, text));
  CHECK(text == wanted);
  put(path, "");
  CHECK(hrad::read_file(path, text) && text.empty());
  CHECK_FAILS(hrad::read_file(folder.path, text), Status::file, "Is a directory");
  CHECK_FAILS(hrad::read_file("/dev/zero", text), Status::file, "not a regular file");
  CHECK(mkfifo((folder.path + "/fifo").c_str(), 0600) == 0);
  CHECK_FAILS(hrad::read_file(folder.path + "/fifo", text), Status::file, "not a regular file");
  CHECK(symlink("loop", (folder.path + "/loop").c_str()) == 0);
  CHECK_FAILS(hrad::read_file(folder.path + "/loop", text), Status::file, "loop: cannot open: Too");
  CHECK(truncate(path.c_str(), int64_t{1} << 42) == 0);
  CHECK_FAILS(hrad::read_file(path, text), Status::memory, "larger than half the memory");
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(appears_only_when_committed),
      HRAD_TEST(abandoned_file_leaves_the_old_one),
      HRAD_TEST(large_and_small_pieces_keep_their_order),
      HRAD_TEST(two_writers_in_one_process),
      HRAD_TEST(finished_is_not_committed),
      HRAD_TEST(mode_and_links_are_kept),
      HRAD_TEST(the_longest_name_works),
      HRAD_TEST(what_can_not_be_kept_is_not_replaced),
      HRAD_TEST(older_files_are_kept_after_a_writer_was_killed),
      HRAD_TEST(reading),
      HRAD_TEST(refused_targets),
      HRAD_TEST(failed_writes_leave_nothing),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
