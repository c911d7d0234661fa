// A lock against a second writer of a file: held by one process at a time, and gone with it however
// it ends. Floor 2 (machine).
#pragma once

#include <string>

namespace hrad {

class FileLock {
 public:
  // FILE when somebody else holds the lock of this file, which need not exist. Links in the path
  // are followed. The lock is on NAME.lock beside it, which is removed at the end. Temporaries that
  // killed writers of the file have left are removed.
  explicit FileLock(const std::string& path);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  // Whether it is the lock of this file.
  bool is_of(const std::string& path) const { return lock_name(path) == name_; }

 private:
  static std::string resolved(const std::string& path);
  static std::string lock_name(const std::string& path) { return resolved(path) + ".lock"; }

  std::string name_;
  int file_ = -1;
};

}  // namespace hrad
