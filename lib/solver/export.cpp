// The choice of an export format by the ending of the path. Floor 8 (solver).
#include "solver/export.h"

#include "base/error.h"
#include "scene/load.h"
#include "solver/solver.h"

namespace hrad {
namespace {

void export_scene(const Solver& solver, const std::string& path) {
  write_obj(solver.scene(), path);
}

struct Format {
  const char* ending;
  void (*write)(const Solver&, const std::string&);
  bool needs_solution;
};

constexpr Format formats[] = {{".csv", export_csv, true},
                              {".vtu", export_vtu, true},
                              {".ply", export_ply, true},
                              {".glb", export_glb, true},
                              {".obj", export_scene, false}};

// From the last dot of the file's name on, in lower case; "" without a dot.
std::string ending_of(const std::string& path) {
  const size_t dot = path.find_last_of("./");
  if (dot == std::string::npos || path[dot] == '/') return "";
  std::string ending = path.substr(dot);
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

std::string writable_endings() {
  std::string list;
  for (const Format& f : formats) list += (list.empty() ? "" : ", ") + std::string(f.ending);
  return list;
}

}  // namespace

bool needs_solution(const std::string& path) {
  const std::string ending = ending_of(path);
  for (const Format& f : formats)
    if (ending == f.ending) return f.needs_solution;
  return false;  // it will be refused for its ending
}

void export_solution(const Solver& solver, const std::string& path) {
  const std::string ending = ending_of(path);
  for (const Format& f : formats) {
    if (ending != f.ending) continue;
    f.write(solver, path);
    return;
  }
  fail(Status::argument, "%s: its ending names no export format; use one of %s", path.c_str(),
       writable_endings().c_str());
}

}  // namespace hrad
