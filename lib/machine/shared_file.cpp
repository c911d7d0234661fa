// One temporary under one name, opened by all. Floor 2 (machine).
#include "machine/shared_file.h"

#include <unistd.h>

#include <chrono>
#include <cstring>

#include "base/error.h"
#include "machine/file_part_self.h"
#include "machine/sharing.h"

namespace hrad {
namespace {

// The first bytes of the temporary until they are written: processes on other machines may see
// another file under this name, or one that somebody has left behind.
struct Mark {
  int64_t process, time;
};

Mark new_mark() {
  return {static_cast<int64_t>(::getpid()),
          static_cast<int64_t>(std::chrono::system_clock::now().time_since_epoch().count())};
}

std::string absolute(const std::string& name) {
  std::string resolved;
  return resolve_path(name, resolved) ? resolved : name;
}

}  // namespace

SharedFile::SharedFile(Comm& comm, const std::string& path) : comm_(comm), path_(path) {
  if (comm.rank() == 0) whole_ = std::make_unique<WholeFile>(path);
  if (!comm.alone()) open_part();
}

void SharedFile::open_part() {
  Mark mark = {};
  Bytes told;
  if (whole_) {
    mark = new_mark();
    whole_->write(&mark, sizeof mark);
    whole_->synchronise();
    put(told, &mark, 1);
    put_list(told, absolute(whole_->temporary()));
    put_list(told, path_);
  }
  comm_.broadcast(told);
  Taker taker(told);
  std::string name;
  taker.take(&mark, 1);
  take_list(taker, name);
  take_list(taker, path_);
  try {
    part_ = comm_.open_part(name, path_);
    if (!part_) part_ = std::make_unique<FilePartSelf>(name, path_);
    Mark found;
    if (!part_->read_start(reinterpret_cast<char*>(&found), sizeof found) ||
        std::memcmp(&found, &mark, sizeof mark) != 0)
      fail(Status::file, "%s: cannot open: another file is there", path_.c_str());
  } catch (const Error& error) {
    if (comm_.rank() == 0) throw;
    fail(Status::file, "%s (on rank %d: all ranks write this file, in a folder that all can reach)",
         error.what(), comm_.rank());
  }
  comm_.all_go_on();  // before anybody writes over the mark
}

void SharedFile::write_at(uint64_t offset, const void* data, size_t size) {
  if (part_)
    part_->write_at(offset, static_cast<const char*>(data), size);
  else
    whole_->write_at(offset, data, size);
}

void SharedFile::commit_keeping(int older) {
  if (part_) part_->finish();
  part_.reset();
  comm_.all_go_on();
  if (whole_) whole_->commit_keeping(older);
}

}  // namespace hrad
