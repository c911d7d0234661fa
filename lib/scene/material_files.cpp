// Finds and reads MTL files. Floor 3 (scene).
#include "scene/material_files.h"

#include <algorithm>
#include <set>

#include "base/error.h"
#include "machine/file_self.h"
#include "scene/obj_lexer.h"

namespace hrad {

namespace {

constexpr int64_t most_named = 8;  // missing files that get a sentence of their own

bool ends_with_mtl(std::string_view word) {
  if (word.size() < 4) return false;
  const std::string_view ending = word.substr(word.size() - 4);
  return ending == ".mtl" || ending == ".MTL";
}

// Whether the words of a path themselves lead out of the folder it is relative to.
bool leads_out(const std::string& name) {
  bool leaves = name[0] == '/';
  for (size_t begin = 0; begin <= name.size();) {
    const size_t end = std::min(name.find('/', begin), name.size());
    leaves = leaves || name.compare(begin, end - begin, "..") == 0;
    begin = end + 1;
  }
  return leaves;
}

class MaterialFiles {
 public:
  MaterialFiles(const std::string& path, MtlLibrary& library, std::vector<std::string>& diagnostics)
      : path_(path), library_(library), diagnostics_(diagnostics) {
    const size_t slash = path.rfind('/');
    if (slash != std::string::npos) folder_ = path.substr(0, slash + 1);
    resolve_path(folder_.empty() ? "." : folder_, real_folder_);
    if (real_folder_.empty() || real_folder_.back() != '/') real_folder_ += '/';
  }

  // One name with blanks if there is such a file, otherwise several names: each goes up to a word
  // that ends in .mtl, or to the end.
  void read(const ObjContent::Library& statement) {
    line_ = statement.line;
    if (read_file_named(statement.names)) return;
    std::vector<std::string_view> words;
    split_words(statement.names, words);
    const char* begin = nullptr;
    for (size_t i = 0; i < words.size(); ++i) {
      if (!begin) begin = words[i].data();
      if (!ends_with_mtl(words[i]) && i + 1 < words.size()) continue;
      const char* end = words[i].data() + words[i].size();
      const std::string name(begin, static_cast<size_t>(end - begin));
      begin = nullptr;
      if (!read_file_named(name) && missing_.insert(name).second &&
          missing_.size() <= static_cast<size_t>(most_named))
        diagnostics_.push_back(place() + ": no file " + quoted(folder_ + name) +
                               ": its materials are unknown");
    }
  }

  void describe_the_rest() {
    const int64_t missing = static_cast<int64_t>(missing_.size());
    if (missing > most_named)
      diagnostics_.push_back(path_ + ": " + std::to_string(missing - most_named) +
                             " further files of materials are missing");
    if (repeated_)
      diagnostics_.push_back(
          std::to_string(repeated_) +
          " mtllib that repeat an earlier one are ignored (first: " + first_repeated_ + ")");
  }

 private:
  std::string place() const { return path_ + ":" + std::to_string(line_); }

  [[noreturn]] void fail_here(const std::string& message) const {
    throw Error(Status::scene, place() + ": mtllib " + message);
  }

  // False when there is no such file.
  bool read_file_named(const std::string& name) {
    // A scene may come from anywhere: it names files of its own folder and the folders below.
    if (leads_out(name))
      fail_here(quoted(name) + " lies outside the folder of the scene and is refused");
    if (missing_.count(name)) return false;
    std::string resolved, text;
    try {
      if (!resolve_path(folder_ + name, resolved)) return false;
      if (resolved.compare(0, real_folder_.size(), real_folder_) != 0)
        fail_here(quoted(name) + " is a link out of the folder of the scene and is refused");
      if (!read_.insert(resolved).second) {
        if (repeated_++ == 0) first_repeated_ = place();
        return true;
      }
      if (!read_file(resolved, text)) return false;
    } catch (const Error& error) {
      if (error.status() != Status::file) throw;
      // The reason, which stands behind the path.
      const std::string reason = error.what(), given = folder_ + name;
      fail_here(quoted(name) + reason.substr(resolved.empty() ? given.size() : resolved.size()));
    }
    read_mtl(folder_ + name, text, library_);
    return true;
  }

  const std::string& path_;
  std::string folder_, real_folder_;  // as given, and with links resolved; both end with a slash
  MtlLibrary& library_;
  std::vector<std::string>& diagnostics_;
  int64_t line_ = 0, repeated_ = 0;
  std::string first_repeated_;
  std::set<std::string> read_, missing_;  // by resolved path; by name
};

}  // namespace

void read_material_files(const std::string& path, const ObjContent& content, MtlLibrary& library,
                         std::vector<std::string>& diagnostics) {
  if (content.libraries.empty()) return;
  MaterialFiles files(path, library, diagnostics);
  for (const ObjContent::Library& statement : content.libraries) files.read(statement);
  files.describe_the_rest();
}

}  // namespace hrad
