// Files named by -o (output_files.h). CLI: public headers only.
#include "output_files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>

#include "exit_code.h"
#include "launcher.h"
#include "render/picture.h"
#include "render/png_file.h"
#include "signals.h"

namespace hrad::cli {
namespace {

struct Format {
  const char* ending;
  OutputFiles::Kind kind;
};

constexpr Format formats[] = {
    {".hrad", OutputFiles::results},   {".csv", OutputFiles::results},
    {".vtu", OutputFiles::results},    {".ply", OutputFiles::results},
    {".glb", OutputFiles::results},    {".png", OutputFiles::results},
    {".png", OutputFiles::pictures},   {".obj", OutputFiles::scenes},
    {".vtu", OutputFiles::partitions},
};

const char* content_of(OutputFiles::Kind kind) {
  return kind == OutputFiles::scenes       ? "a scene"
         : kind == OutputFiles::pictures   ? "a picture"
         : kind == OutputFiles::partitions ? "a partition"
                                           : "a result";
}

std::string name_of(const std::string& path) {
  return path.substr(path.find_last_of('/') + 1);  // npos + 1 is 0
}

std::string folder_of(const std::string& path) {
  const size_t slash = path.find_last_of('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

std::string ending_of(const std::string& path) {
  const std::string name = name_of(path);
  const size_t dot = name.find_last_of('.');
  return dot == std::string::npos ? "" : name.substr(dot);
}

bool is_picture(const std::string& path) { return ending_of(path) == ".png"; }

std::string known_endings(OutputFiles::Kind kind) {
  std::string endings;
  for (const Format& format : formats)
    if (format.kind == kind) endings += (endings.empty() ? "" : ", ") + std::string(format.ending);
  return endings;
}

void check_ending(const std::string& path, OutputFiles::Kind kind) {
  const std::string ending = ending_of(path);
  const std::string hint = "endings known here: " + known_endings(kind);
  const Format* known = nullptr;  // the ending's row for this kind, or for another one
  for (const Format& format : formats)
    if (ending == format.ending && (known == nullptr || format.kind == kind)) known = &format;
  if (known == nullptr)
    throw Failure(exit_usage,
                  "-o " + path + ": " +
                      (ending.empty() ? "no ending tells the format" : "unknown ending " + ending),
                  hint);
  if (known->kind != kind)
    throw Failure(exit_usage,
                  "-o " + path + ": a " + ending + " file holds " + content_of(known->kind) +
                      ", not " + content_of(kind),
                  hint);
  if (is_picture(path)) require_png(path);
}

[[noreturn]] void fail_to_write(const std::string& path, const std::string& reason) {
  throw Failure(exit_input_output, "can't write '" + path + "': " + reason);
}

}  // namespace

void check_place(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) fail_to_write(path, "it is a directory");
    if (::access(path.c_str(), W_OK) != 0) fail_to_write(path, std::strerror(errno));
  }
  const std::string folder = folder_of(path);
  if (::stat(folder.c_str(), &status) != 0)
    fail_to_write(path, "directory '" + folder + "': " + std::strerror(errno));
  if (!S_ISDIR(status.st_mode)) fail_to_write(path, "'" + folder + "' is not a directory");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    fail_to_write(path, "directory '" + folder + "': " + std::strerror(errno));
}

bool same_file(const std::string& one, const std::string& other) {
  struct stat a {
  }, b{};
  const bool one_exists = ::stat(one.c_str(), &a) == 0;
  const bool other_exists = ::stat(other.c_str(), &b) == 0;
  if (!one_exists && !other_exists) {
    // What is not there yet is the same when its directory and its name are.
    if (name_of(one) != name_of(other) || ::stat(folder_of(one).c_str(), &a) != 0 ||
        ::stat(folder_of(other).c_str(), &b) != 0)
      return one == other;
  } else if (!one_exists || !other_exists) {
    return false;
  }
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

void OutputFiles::add_to(Arguments* arguments, const std::string& command) {
  command_ = command;
  arguments->add_list("-o,--output", "FILE", &paths_,
                      "Write this file; its ending tells the format: " + known_endings(kind_));
}

void OutputFiles::check_other(const std::string& other, const std::string& what) const {
  for (const std::string& path : paths_)
    if (same_file(path, other)) fail_usage(command_, "-o " + path + " would write over " + what);
}

void OutputFiles::check(const std::string& input_file) const {
  launcher::on_first([&] { check_all(input_file); });
}

void OutputFiles::check_all(const std::string& input_file) const {
  for (const std::string& path : paths_) check_ending(path, kind_);
  for (size_t i = 0; i < paths_.size(); ++i) {
    if (!input_file.empty() && same_file(paths_[i], input_file))
      fail_usage(command_, "-o " + paths_[i] + " would write over the input");
    for (size_t j = 0; j < i; ++j)
      if (same_file(paths_[i], paths_[j]))
        fail_usage(command_, "-o " + paths_[i] + " is given twice");
  }
  for (const std::string& path : paths_) check_place(path);
}

double OutputFiles::write(Session* session) const {
  const auto start = std::chrono::steady_clock::now();
  for (const std::string& path : paths_) {
    if (is_picture(path))
      write_png(make_automatic_picture(session), path);
    else if (is_checkpoint(path))
      session->write_result(path);
    else
      hrad::cli::check(hrad_export(session->solver(), path.c_str()));
    signals::check();
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace hrad::cli
