// Counting what is in a scene (scene_report.h). CLI: public headers only.
#include "scene_report.h"

#include <algorithm>
#include <limits>

#include "signals.h"

namespace hrad::cli {
namespace {

std::vector<MaterialReport> fetch_materials(Session* session, size_t bands) {
  int64_t count = 0;
  check(hrad_scene_size(session->solver(), nullptr, &count));
  std::vector<MaterialReport> materials(static_cast<size_t>(count));
  for (size_t i = 0; i < materials.size(); ++i) {
    MaterialReport& material = materials[i];
    const auto number = static_cast<int32_t>(i);
    material.reflectance.resize(bands);
    material.emission.resize(bands);
    material.name = fetch_text([&](char* text, int64_t size, int64_t* needed) {
      return hrad_get_material(session->solver(), number, text, size, needed,
                               material.reflectance.data(), material.emission.data(),
                               &material.flags);
    });
  }
  return materials;
}

void count_patch(const hrad_patch& patch, const double* emission, SceneReport* report) {
  if (patch.flags & HRAD_PATCH_DROPPED) {
    ++report->dropped;
    return;
  }
  const bool two_sided = (patch.flags & HRAD_PATCH_TWO_SIDED) != 0;
  report->two_sided += two_sided;
  report->blockers += (patch.flags & HRAD_PATCH_BLOCKER) != 0;
  report->area += patch.area;
  bool emits = false;
  for (size_t band = 0; band < report->power.size(); ++band) {
    report->power[band] += (two_sided ? 2 : 1) * emission[band] * patch.area;
    emits = emits || emission[band] > 0;
  }
  report->emitters += emits;
  for (int i = 0; i < 9; ++i) {
    report->lower[i % 3] = std::min(report->lower[i % 3], patch.corners_xyz[i]);
    report->upper[i % 3] = std::max(report->upper[i % 3], patch.corners_xyz[i]);
  }
  const auto material = static_cast<size_t>(patch.material);
  if (patch.material < 0 || material >= report->materials.size()) return;
  MaterialReport& its = report->materials[material];
  ++its.patches;
  its.area += patch.area;
  report->own_emission += !std::equal(its.emission.begin(), its.emission.end(), emission);
}

}  // namespace

SceneReport make_scene_report(Session* session) {
  SceneReport report;
  const auto bands = static_cast<size_t>(session->bands());
  report.materials = fetch_materials(session, bands);
  report.power.resize(bands);
  report.patches = session->patches();
  report.diagnostics = session->diagnostics();
  report.unit = session->parameter("unit");
  std::fill(report.lower, report.lower + 3, std::numeric_limits<double>::infinity());
  std::fill(report.upper, report.upper + 3, -std::numeric_limits<double>::infinity());

  constexpr int64_t most_at_once = 65536;
  std::vector<double> emission;
  for (int64_t first = 0; first < report.patches; first += most_at_once) {
    const int64_t count = std::min(most_at_once, report.patches - first);
    emission.resize(static_cast<size_t>(count) * bands);
    check(hrad_query_patches(session->solver(), HRAD_EMISSION, HRAD_FRONT, first, count,
                             emission.data()));
    for (int64_t i = 0; i < count; ++i) {
      hrad_patch patch{};
      patch.struct_size = sizeof patch;
      check(hrad_get_patch(session->solver(), first + i, &patch));
      count_patch(patch, &emission[static_cast<size_t>(i) * bands], &report);
    }
    signals::check();
  }
  if (report.patches == report.dropped) {
    std::fill(report.lower, report.lower + 3, 0.0);
    std::fill(report.upper, report.upper + 3, 0.0);
  }
  return report;
}

}  // namespace hrad::cli
