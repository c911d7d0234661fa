// Locks by flock(2), which belong to an open file and end with it. Floor 2 (machine).
#include "machine/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "machine/file_self.h"

namespace hrad {
namespace {

constexpr int attempts = 100;  // others may remove the file just when it was opened

// Some file systems have no locks: there a second writer is the user's own care.
bool has_no_locks(int error) {
  return error == ENOTSUP || error == EOPNOTSUPP || error == ENOSYS || error == EINVAL ||
         error == ENOLCK;
}

bool still_has_name(int file, const std::string& name) {
  struct stat here, there;
  return ::fstat(file, &here) == 0 && ::stat(name.c_str(), &there) == 0 &&
         here.st_dev == there.st_dev && here.st_ino == there.st_ino;
}

// 0: locked. It doesn't wait for another's lock.
int error_of_locking(int file) {
  int error = EINTR;
  for (int attempt = 0; attempt < attempts && error == EINTR; ++attempt)
    error = ::flock(file, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
  return error;
}

}  // namespace

std::string FileLock::resolved(const std::string& path) {
  std::string resolved;
  if (resolve_path(path, resolved)) return resolved;
  // Of a file that is not there yet, the folder has a name that stays.
  const size_t slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
  const std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  if (!resolve_path(folder, resolved)) resolved = folder;
  return resolved + (resolved.back() == '/' ? "" : "/") + name;
}

FileLock::FileLock(const std::string& path) : name_(lock_name(path)) {
  if (path.empty()) fail(Status::file, "the path of the checkpoint is empty");
  struct stat status;
  if (path.back() == '/' || (::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)))
    fail(Status::file, "%s: cannot lock it: it is a directory", path.c_str());
  const TemporaryNames temporaries(resolved(path));
  for (int attempt = 0; attempt < attempts; ++attempt) {
    constexpr int flags = O_RDWR | O_CLOEXEC | O_NOFOLLOW;
    file_ = ::open(name_.c_str(), flags | O_CREAT | O_EXCL, 0666);
    const bool made = file_ >= 0;
    if (file_ < 0 && errno == EEXIST) file_ = ::open(name_.c_str(), flags);
    if (file_ < 0 && (errno == EINTR || errno == ENOENT) && attempt + 1 < attempts) continue;
    if (file_ < 0)
      fail(Status::file, "%s: cannot create the lock %s: %s", path.c_str(), name_.c_str(),
           std::strerror(errno));
    const int error = error_of_locking(file_);
    if (error == 0 && still_has_name(file_, name_)) {
      // Whoever could still be at work on them would hold the lock.
      temporaries.remove_all();
      return;
    }
    if (has_no_locks(error)) return;
    if (made && error != 0 && error != EWOULDBLOCK) ::unlink(name_.c_str());
    ::close(file_);
    file_ = -1;
    if (error == 0) continue;
    if (error == EWOULDBLOCK)
      fail(Status::file, "%s: another process is at work on this checkpoint (it holds %s)",
           path.c_str(), name_.c_str());
    fail(Status::file, "%s: cannot lock %s: %s", path.c_str(), name_.c_str(), std::strerror(error));
  }
  fail(Status::file, "%s: cannot lock %s: it comes and goes", path.c_str(), name_.c_str());
}

FileLock::~FileLock() {
  if (file_ < 0) return;
  // While it is still locked nobody else can have it by this name; but the folder may have been
  // removed, and another one have its name.
  if (still_has_name(file_, name_)) ::unlink(name_.c_str());
  ::close(file_);
}

}  // namespace hrad
