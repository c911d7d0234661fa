// Files of one process. Writing: temporary, checked writes, fsync, rename. Floor 2 (machine).
#include "machine/file_self.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "machine/descriptor.h"
#include "machine/host_name.h"

namespace hrad {

namespace {

constexpr size_t buffer_bytes = size_t{1} << 18;  // few system calls, little memory
constexpr int name_attempts = 10000;              // left-over temporaries of as many dead processes
constexpr mode_t owner_opens = S_IRUSR | S_IWUSR;

std::string folder_of(const std::string& path) {
  const size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}

constexpr char temporary_end[] = ".tmp";

uint64_t hash_of(const char* text) {
  Hasher hasher;
  hasher.add(text);
  return hasher.value();
}

}  // namespace

// Of the name in the folder, which may be reached by other paths elsewhere; and of a length of
// their own, because that name may already be as long as the file system allows.
TemporaryNames::TemporaryNames(const std::string& target)
    : folder(folder_of(target)),
      beginning(format(".hrad-%016llx-", static_cast<unsigned long long>(
                                             hash_of(target.c_str() + (target.rfind('/') + 1))))) {}

// Processes of several machines may have one number.
std::string TemporaryNames::name(int attempt) const {
  return folder + (folder.back() == '/' ? "" : "/") + beginning +
         format("%08x-%ld-%d", static_cast<unsigned>(hash_of(host_name().c_str()) >> 32),
                static_cast<long>(::getpid()), attempt) +
         temporary_end;
}

// Or of a file that MPI has for a moment beside it, of its name and more behind a dot.
bool TemporaryNames::is_one(const char* name) const {
  if (std::strncmp(name, beginning.c_str(), beginning.size()) != 0) return false;
  const char* rest = name + beginning.size();
  const char* end = std::strstr(rest, temporary_end);
  if (!end || end == rest) return false;
  end += sizeof temporary_end - 1;
  return *end == '\0' || *end == '.';
}

// Allocates nothing by itself, so that nothing is thrown where the lock was just taken.
void TemporaryNames::remove_all() const {
  DIR* entries = ::opendir(folder.c_str());
  if (!entries) return;
  while (const dirent* entry = ::readdir(entries))
    if (is_one(entry->d_name)) ::unlinkat(::dirfd(entries), entry->d_name, 0);
  ::closedir(entries);
}

WholeFile::WholeFile(const std::string& path) : path_(path), target_(path) {
  if (path.empty()) fail_here("create", ENOENT);
  struct stat status;
  if (::stat(path.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) fail_here("create", EISDIR);
    if (!S_ISREG(status.st_mode))
      fail(Status::file, "%s: not a regular file, will not be replaced", path.c_str());
    mode_ = status.st_mode & 07777;
    char* resolved = ::realpath(path.c_str(), nullptr);
    if (!resolved) fail_here("create", errno);
    target_ = resolved;
    std::free(resolved);
  } else if (errno != ENOENT || path.back() == '/') {
    fail_here("create", errno == ENOENT ? EISDIR : errno);
  }
  buffer_.reserve(buffer_bytes);
  try {
    create_temporary();
  } catch (...) {
    discard();  // no destructor runs for what was not made
    throw;
  }
}

WholeFile::~WholeFile() { discard(); }

void WholeFile::discard() {
  if (file_ >= 0) ::close(file_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  if (!second_name_.empty()) ::unlink(second_name_.c_str());
}

void WholeFile::fail_here(const char* step, int error) const {
  fail(Status::file, "%s: cannot %s: %s", path_.c_str(), step, std::strerror(error));
}

// Of a new file the process's umask decides the mode.
void WholeFile::create_temporary() {
  const TemporaryNames names(target_);
  for (int attempt = 0; attempt < name_attempts; ++attempt) {
    std::string name = names.name(attempt);
    file_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file_ >= 0) {
      temporary_ = std::move(name);  // without allocation: from here it is removed
      // Until it is whole, other processes of the same user may have to open it.
      if (mode_ != 0 && ::fchmod(file_, mode_ | owner_opens) != 0)
        fail_here("keep the mode", errno);
      return;
    }
    if (errno != EEXIST && errno != EINTR) break;
  }
  fail_here("create", errno);
}

void WholeFile::write_here(uint64_t offset, const char* data, size_t size) {
  if (const int error = write_all(file_, offset, data, size)) fail_here("write", error);
}

void WholeFile::write_out() {
  write_here(next_ - buffer_.size(), buffer_.data(), buffer_.size());
  buffer_.clear();
}

void WholeFile::write_at(uint64_t offset, const void* data, size_t size) {
  const char* bytes = static_cast<const char*>(data);
  if (offset != next_ || buffer_.size() + size > buffer_bytes) {
    write_out();
    next_ = offset;
  }
  if (size >= buffer_bytes)
    write_here(offset, bytes, size);
  else
    buffer_.insert(buffer_.end(), bytes, bytes + size);
  next_ += size;
}

void WholeFile::synchronise() {
  write_out();
  if (const int error = hrad::synchronise(file_)) fail_here("write", error);
}

void WholeFile::finish() {
  if (file_ < 0) return;
  write_out();
  if ((mode_ & owner_opens) != owner_opens && mode_ != 0 && ::fchmod(file_, mode_) != 0)
    fail_here("keep the mode", errno);
  synchronise();
  if (const int error = close_checked(file_)) fail_here("write", error);
}

void WholeFile::commit() {
  finish();
  take_place();
  synchronise_folder();
}

std::string WholeFile::name_of_older(int number) const {
  return target_ + ".prev" + (number > 1 ? std::to_string(number) : "");
}

// False: there is no old file, or the file system knows no second names.
bool WholeFile::keep_second_name() {
  const TemporaryNames names(target_);
  for (int attempt = 0; attempt < name_attempts; ++attempt) {
    std::string name = names.name(attempt);
    if (::link(target_.c_str(), name.c_str()) == 0) {
      second_name_ = std::move(name);
      return true;
    }
    if (errno == EEXIST || errno == EINTR) continue;
    if (errno == ENOENT || errno == EPERM || errno == ENOTSUP || errno == ENOSYS || errno == EMLINK)
      return false;
    break;
  }
  fail_here("keep the old file", errno);
}

// A writer that ended before its last rename has left the old file both names.
bool WholeFile::is_kept_already() const {
  struct stat target, prev;
  return ::lstat(target_.c_str(), &target) == 0 &&
         ::lstat(name_of_older(1).c_str(), &prev) == 0 && target.st_dev == prev.st_dev &&
         target.st_ino == prev.st_ino;
}

// Makes NAME.prev free.
void WholeFile::move_older(int older) {
  for (int number = older; number > 1; --number)
    if (::rename(name_of_older(number - 1).c_str(), name_of_older(number).c_str()) != 0 &&
        errno != ENOENT)
      fail_here("keep the old file", errno);
}

void WholeFile::take_place() {
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail_here("replace", errno);
  temporary_.clear();
}

void WholeFile::commit_keeping(int older) {
  finish();
  if (older < 1) return commit();
  const std::string prev = name_of_older(1);
  if (is_kept_already()) {
    take_place();
  } else if (keep_second_name()) {
    // At no time is the old content without a name.
    move_older(older);
    if (::rename(second_name_.c_str(), prev.c_str()) != 0) fail_here("keep the old file", errno);
    second_name_.clear();
    take_place();
  } else {
    move_older(older);
    const bool kept = ::rename(target_.c_str(), prev.c_str()) == 0;
    if (!kept && errno != ENOENT) fail_here("keep the old file", errno);
    try {
      take_place();
    } catch (...) {
      if (kept) static_cast<void>(::rename(prev.c_str(), target_.c_str()));
      throw;
    }
  }
  synchronise_folder();
}

void WholeFile::synchronise_folder() const {
  // The new name must survive a crash too. From here the file is whole: a folder that can't be
  // synchronised is no failure of this write.
  const int folder =
      ::open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NONBLOCK);
  if (folder < 0) return;
  ::fsync(folder);
  ::close(folder);
}

bool resolve_path(const std::string& path, std::string& resolved) {
  char* found = ::realpath(path.c_str(), nullptr);
  if (!found) {
    if (errno == ENOENT || errno == ENOTDIR || errno == ENAMETOOLONG) return false;
    if (errno == ENOMEM) fail(Status::memory, "out of memory for a path");
    fail(Status::file, "%s: cannot look up: %s", path.c_str(), std::strerror(errno));
  }
  struct Freer {
    char* text;
    ~Freer() { std::free(text); }
  } const freer{found};
  resolved = found;
  return true;
}

bool read_file(const std::string& path, std::string& content) {
  struct Descriptor {
    int file;
    ~Descriptor() {
      if (file >= 0) ::close(file);
    }
  };
  // Without O_NONBLOCK, opening a pipe would wait for a writer.
  const Descriptor in{::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)};
  if (in.file < 0 && (errno == ENOENT || errno == ENOTDIR)) return false;
  struct stat status;
  if (in.file < 0 || ::fstat(in.file, &status) != 0)
    fail(Status::file, "%s: cannot open: %s", path.c_str(), std::strerror(errno));
  if (S_ISDIR(status.st_mode))
    fail(Status::file, "%s: cannot read: %s", path.c_str(), std::strerror(EISDIR));
  if (!S_ISREG(status.st_mode)) fail(Status::file, "%s: not a regular file", path.c_str());
  const double memory =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  if (static_cast<double>(status.st_size) > memory / 2)
    fail(Status::memory, "%s: larger than half the memory of this machine", path.c_str());
  content.resize(static_cast<size_t>(status.st_size));
  size_t size = 0;
  while (size < content.size()) {
    const ssize_t count = ::read(in.file, &content[size], content.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(Status::file, "%s: cannot read: %s", path.c_str(), std::strerror(errno));
    if (count == 0) break;
    size += static_cast<size_t>(count);
  }
  content.resize(size);
  return true;
}

}  // namespace hrad
