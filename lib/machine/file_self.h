// Files of one process: read at once into memory; written so that they appear whole under their
// name or not at all. Floor 2 (machine).
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hrad {

// What the temporaries of a file are called: they lie beside it and carry a hash of its name, so
// that they can be told from those of other files, a hash of the machine's name, and the number of
// the process that writes.
struct TemporaryNames {
  explicit TemporaryNames(const std::string& target);  // no symbolic link
  std::string name(int attempt) const;
  // Removes all of them, whichever process of whichever machine they are of: for who keeps every
  // other writer of the target away (FileLock). What can't be removed stays.
  void remove_all() const;
  bool is_one(const char* name) const;  // without its folder

  std::string folder, beginning;
};

// Bytes go to a temporary beside the target; commit() puts it in the target's place. Until then,
// and when anything fails, the old file is untouched. A symbolic link is followed; a target that is
// no regular file (a folder, a device) is refused. Every failure throws FILE with the path and the
// system's reason.
class WholeFile {
 public:
  explicit WholeFile(const std::string& path);
  ~WholeFile();  // removes the temporary unless it was committed
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  // Behind what was written last.
  void write(const void* data, size_t size) { write_at(next_, data, size); }
  void text(const std::string& text) { write(text.data(), text.size()); }
  // At a place of its own, which may have been written before.
  void write_at(uint64_t offset, const void* data, size_t size);
  // Makes what was written so far known to whoever opens the temporary, on whatever machine.
  void synchronise();
  const std::string& temporary() const { return temporary_; }
  // Writes everything out and closes the temporary: after it only the rename can fail. For several
  // files that belong together, finish all, then commit all.
  void finish();
  void commit();  // once, as the last call; finishes what is not
  // The same, and the file that was there until now stays as NAME.prev, the one of that name as
  // NAME.prev2, and so on: `older` of them. NAME is there all the time, where the file system knows
  // second names.
  void commit_keeping(int older);

 private:
  void discard();  // what is not committed
  [[noreturn]] void fail_here(const char* step, int error) const;
  void create_temporary();
  void write_out();
  void write_here(uint64_t offset, const char* data, size_t size);
  std::string name_of_older(int number) const;
  bool is_kept_already() const;
  bool keep_second_name();
  void move_older(int older);
  void take_place();
  void synchronise_folder() const;

  std::string path_, target_, temporary_;  // target: path with links resolved
  std::string second_name_;                // of the old file, for a while
  int file_ = -1;
  mode_t mode_ = 0;           // of the file to be replaced, 0 for a new one
  uint64_t next_ = 0;         // behind what was written last
  std::vector<char> buffer_;  // of that, the bytes that are not written out yet
};

// The path with every link in it resolved. False when nothing has this name, or nothing can have it
// because it is too long; FILE when it can't be looked up.
bool resolve_path(const std::string& path, std::string& resolved);

// Reads a regular file. False when nothing has this name; FILE for anything else that is no regular
// file (a folder, a device, a pipe: it is not waited for) or can't be read; MEMORY for one larger
// than half this machine's memory.
bool read_file(const std::string& path, std::string& content);

}  // namespace hrad
