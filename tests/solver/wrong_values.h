// Files whose frame and checksums are right and one value of which can't be, for tests that they
// are refused.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "solver/checkpoint.h"
#include "solver/checkpoint_files.h"
#include "support/checkpoint_frame.h"

namespace hrad_test {

using hrad::PackedBytes;
using hrad::PackedReader;
using hrad::Section;

inline std::vector<FrameRun>& section_of(Frame& frame, Section section) {
  return frame[static_cast<size_t>(section)];
}

inline const std::string& first_run_of(const Frame& frame, Section section) {
  return frame[static_cast<size_t>(section)][0].raw;
}

inline PackedReader reader_of(const std::string& raw) {
  return {raw.data(), raw.size(), {"test", 0}};
}

// A small file, whose sections of the scene have one run each.
struct Good {
  explicit Good(const SolveCase& c) : Good(solver_of(c)) {}
  explicit Good(const std::unique_ptr<hrad::Solver>& solver) {
    const Folder folder("values");
    solver->solve();
    solver->write_checkpoint(folder.file("a.hrad"));
    frame = frame_of(bytes_of_file(folder.file("a.hrad")));
    scene = solver->scene();
    PackedReader sizes = reader_of(section_of(frame, Section::sizes)[0].raw);
    std::vector<int64_t> n;
    while (sizes.left() > 0) n.push_back(static_cast<int64_t>(sizes.varint()));
    surfaces = n[4];
    emitters = n[4] + n[5];
    nodes = emitters + 4 * n[6];
    points = n[12];
    check_accepted(frame);
  }

  static void check_accepted(const Frame& frame) {
    static_cast<void>(hrad::read_checkpoint(file_of(frame), 0));
  }

  Frame frame;
  hrad::Scene scene;
  // emitters: nodes that direct light may come from, surfaces and then clusters.
  int64_t surfaces, emitters, nodes, points;
};

// Refused as damaged, with the section and the text.
inline void refuses(const Frame& frame, Section section, const std::string& text) {
  try {
    static_cast<void>(hrad::read_checkpoint(file_of(frame), 0));
  } catch (const hrad::Error& error) {
    const std::string message = error.what();
    CHECK(error.status() == hrad::Status::format);
    const std::string named = std::string("section '") + hrad::section_name(section) + "', byte ";
    if (message.find(named) == std::string::npos || message.find(text) == std::string::npos)
      failed(__FILE__, __LINE__, "wanted " + named + "... " + text + ", got: " + message);
    return;
  }
  failed(__FILE__, __LINE__, "accepted, wanted: " + text);
}

// The good file with other bytes in the first run of a section.
inline Frame with(const Good& good, Section section, const PackedBytes& bytes) {
  Frame frame = good.frame;
  section_of(frame, section)[0].raw = bytes.bytes();
  return frame;
}

}  // namespace hrad_test
