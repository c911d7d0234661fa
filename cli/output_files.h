// The files that -o names: judged before any work is done, written after it. CLI: public headers
// only.
#pragma once

#include <string>
#include <vector>

#include "arguments.h"
#include "session.h"

namespace hrad::cli {

class OutputFiles {
 public:
  // A kind of file is known by its ending; a picture is also one form of a result.
  enum Kind { results, scenes, pictures, partitions };

  explicit OutputFiles(Kind kind) : kind_(kind) {}
  void add_to(Arguments* arguments, const std::string& command);

  // Failure (usage) for an unknown ending, a name given twice or the input's own; Failure
  // (input/output) where it can be seen that writing would fail.
  void check(const std::string& input_file) const;
  // Failure (usage) when a file is this one: what it is, as "the checkpoint".
  void check_other(const std::string& other, const std::string& what) const;
  // Writes all files of results or scenes, each whole or not at all, and returns the seconds it
  // took. Pictures among them are from the automatic camera.
  double write(Session* session) const;

  const std::vector<std::string>& paths() const { return paths_; }

 private:
  void check_all(const std::string& input_file) const;

  Kind kind_;
  std::string command_;
  std::vector<std::string> paths_;
};

// Whether two paths lead to one file, which need not be there yet.
bool same_file(const std::string& one, const std::string& other);
// Failure (input/output) where it can be seen that a file can't be written.
void check_place(const std::string& path);

}  // namespace hrad::cli
