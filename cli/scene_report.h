// What `hrad info` says of a scene: sizes, materials, what is doubtful. CLI: public headers only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "session.h"

namespace hrad::cli {

struct MaterialReport {
  std::string name;
  std::vector<double> reflectance, emission;  // per band; W/m2
  int32_t flags = 0;
  int64_t patches = 0;  // not dropped
  double area = 0;      // of one side
};

struct SceneReport {
  int64_t patches = 0, dropped = 0, two_sided = 0, blockers = 0, emitters = 0;
  int64_t own_emission = 0;  // patches whose emission is not that of their material
  double lower[3] = {0, 0, 0}, upper[3] = {0, 0, 0};  // the box around what is not dropped
  double area = 0;                                    // of one side
  std::vector<double> power;                          // emitted, W per band, all sides
  std::vector<MaterialReport> materials;
  std::vector<std::string> diagnostics;
  std::string unit;
};

SceneReport make_scene_report(Session* session);

}  // namespace hrad::cli
