// The lock of a file: one holder, whichever way its path is written; who holds it removes what
// killed writers of this file have left, and nothing that anybody else may need.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>  // before cmocka, whose fail() is a macro
#include <memory>

#include "base/error.h"
#include "machine/file_lock.h"
#include "machine/file_self.h"
#include "support/check.h"
#include "support/folder.h"

using hrad::FileLock;
using hrad::Status;
using hrad::TemporaryNames;
using hrad::WholeFile;
using namespace hrad_test;

namespace {

// A process that is killed while it writes the file.
void write_and_be_killed(const std::string& path) {
  const pid_t writer = fork();
  if (writer == 0) {
    WholeFile file(path);
    file.text("never finished");
    raise(SIGKILL);
  }
  int status = 0;
  CHECK(writer > 0 && waitpid(writer, &status, 0) == writer);
  CHECK(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
}

void there_is_one_holder() {
  const Folder folder("lock");
  std::filesystem::create_symlink("a.hrad", folder.file("link.hrad"));
  write_bytes(folder.file("a.hrad"), "old");
  auto lock = std::make_unique<FileLock>(folder.file("a.hrad"));
  for (const char* same : {"a.hrad", "./a.hrad", "link.hrad"}) {
    CHECK(lock->is_of(folder.file(same)));
    CHECK_FAILS(FileLock(folder.file(same)), Status::file, "another process is at work");
  }
  CHECK(!lock->is_of(folder.file("b.hrad")));
  const FileLock other(folder.file("b.hrad"));
  lock.reset();
  CHECK(!std::filesystem::exists(folder.file("a.hrad.lock")));
  const FileLock again(folder.file("link.hrad"));
}

void left_overs_of_its_file_are_removed() {
  const Folder folder("lock");
  const std::string path = folder.file("a.hrad");
  for (int k = 0; k < 3; ++k) write_and_be_killed(path);
  // Of another machine; nobody here can tell whether it is at work, but for the lock.
  const std::string far = folder.file(TemporaryNames(path).beginning + "00000000-1-0.tmp");
  write_bytes(far, "far away");
  // Of MPI, while it opened that.
  write_bytes(far + ".locktest.0", "");
  CHECK_EQUAL(folder.count(), 5);
  write_bytes(path, "old");
  { const FileLock lock(path); }
  CHECK_EQUAL(folder.count(), 1);
  CHECK(bytes_of_file(path) == "old");
}

void left_overs_are_found_by_any_path() {
  const Folder folder("lock");
  std::filesystem::create_directory(folder.file("in"));
  std::filesystem::create_directory_symlink("in", folder.file("to"));
  std::filesystem::create_symlink("in/a.hrad", folder.file("link.hrad"));
  write_and_be_killed(folder.file("in/a.hrad"));
  { const FileLock lock(folder.file("to/a.hrad")); }
  CHECK(std::filesystem::is_empty(folder.file("in")));
  write_bytes(folder.file("in/a.hrad"), "old");
  write_and_be_killed(folder.file("to/../link.hrad"));
  { const FileLock lock(folder.file("in/../link.hrad")); }
  CHECK_EQUAL(std::distance(std::filesystem::directory_iterator(folder.file("in")), {}), 1);
}

void what_others_write_stays() {
  const Folder folder("lock");
  const std::string path = folder.file("a.hrad");
  write_and_be_killed(folder.file("b.hrad"));
  write_and_be_killed(folder.file("a.vtu"));
  const std::string beginning = TemporaryNames(path).beginning;
  for (const std::string& name :
       {std::string(".hrad-1-0.tmp"), std::string("notes.tmp"), beginning + "notes",
        beginning + "notes.tmpl", beginning.substr(1) + "1-1-0.tmp"})
    write_bytes(folder.file(name), "");
  WholeFile exported(folder.file("c.vtu"));
  exported.text("whole");
  const int64_t there = folder.count();
  {
    const FileLock lock(path);
    CHECK_EQUAL(folder.count(), there + 1);
    WholeFile file(path);
    file.text("new");
    // Who is refused the lock removes nothing.
    CHECK_FAILS(FileLock{path}, Status::file, "another process is at work");
    file.commit_keeping(1);
    CHECK(bytes_of_file(path) == "new");
  }
  exported.commit();
  CHECK(bytes_of_file(folder.file("c.vtu")) == "whole");
  CHECK_EQUAL(folder.count(), there + 1);
}

void the_lock_of_a_folder_that_took_the_place_stays() {
  const Folder folder("lock");
  std::filesystem::create_directory(folder.file("in"));
  {
    const FileLock lock(folder.file("in/a.hrad"));
    std::filesystem::remove_all(folder.file("in"));
    std::filesystem::create_directory(folder.file("in"));
    write_bytes(folder.file("in/a.hrad.lock"), "of somebody else");
  }
  CHECK(std::filesystem::exists(folder.file("in/a.hrad.lock")));
  // Where the folder is gone there is nothing to end.
  {
    const FileLock lock(folder.file("in/b.hrad"));
    std::filesystem::remove_all(folder.file("in"));
  }
  CHECK_EQUAL(folder.count(), 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(there_is_one_holder), HRAD_TEST(left_overs_of_its_file_are_removed),
      HRAD_TEST(left_overs_are_found_by_any_path), HRAD_TEST(what_others_write_stays),
      HRAD_TEST(the_lock_of_a_folder_that_took_the_place_stays)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
