// The solver while its scene is being made: materials, patches and their values, with all checks of
// what a user hands in (paper, Section 3, Initial Stage: the load). Every method does
// its whole work or none. Floor 8 (solver).
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "machine/sharing.h"
#include "scene/load.h"
#include "scene/scene_bytes.h"
#include "solver/scene_addition.h"
#include "solver/solution.h"

namespace hrad {
namespace {

// Radiosity is kept in single precision, which holds these a million times reflected.
constexpr double kSmallestEmission = 1e-30, kLargestEmission = 1e30;
// Share of measuring rays that meet black backs above which windings are probably wrong.
constexpr double kDoubtfulBackShare = 0.05;

// owner and number: whose value it is, as "patch" 7.
void check_reflectance(double value, const char* owner, int64_t number, size_t band) {
  if (!(value >= 0 && value < 1))
    fail(Status::argument,
         "the reflectance of %s %lld in band %zu is %g: it must be at least 0 and less than 1",
         owner, static_cast<long long>(number), band, value);
}

void check_emission(double value, const char* owner, int64_t number, size_t band) {
  if (value != 0 && !(value >= kSmallestEmission && value <= kLargestEmission))
    fail(Status::argument,
         "the emission of %s %lld in band %zu is %g W/m2: it must be 0, or from %g to %g (in "
         "another unit of power if need be)",
         owner, static_cast<long long>(number), band, value, kSmallestEmission, kLargestEmission);
}

void check_patch_range(const Scene& scene, int64_t first, int64_t count) {
  const int64_t patches = scene.patch_count();
  if (first < 0 || count < 0 || first > patches || count > patches - first)
    fail(Status::argument, "%lld patches from %lld on: the scene has %lld patches, from 0 on",
         static_cast<long long>(count), static_cast<long long>(first),
         static_cast<long long>(patches));
}

constexpr const char* no_emitter = "no emitter: no patch emits and the solution is 0 everywhere";

bool any_emitter(const Scene& scene) {
  for (int64_t patch = 0; patch < scene.patch_count(); ++patch)
    if (scene.exchanges(patch) && scene.emits(patch)) return true;
  return false;
}

}  // namespace

// What check_patches and the loaders found since `before` goes to the log as well.
void Solver::warn(size_t before) const {
  for (size_t i = before; i < scene_.diagnostics.size() && describes_scene(); ++i)
    log_.write(Log::warning, scene_.diagnostics[i]);
}

void Solver::require_open() const {
  if (solution_)
    fail(Status::state,
         "the scene was closed by the partition and can't grow: add everything before it, or make "
         "a new solver");
}

int32_t Solver::add_material(Material material) {
  require_open();
  broadcast(*comm_, material);
  const auto bands = static_cast<size_t>(scene_.bands);
  const auto number = static_cast<int64_t>(scene_.materials.size());
  if (number >= std::numeric_limits<int32_t>::max())
    fail(Status::argument, "there are %lld materials already: no more can be numbered",
         static_cast<long long>(number));
  if ((!material.reflectance.empty() && material.reflectance.size() != bands) ||
      (!material.emission.empty() && material.emission.size() != bands))
    fail(Status::argument, "material %lld needs a reflectance and an emission of %zu bands each",
         static_cast<long long>(number), bands);
  for (size_t band = 0; band < material.reflectance.size(); ++band)
    check_reflectance(material.reflectance[band], "material", number, band);
  for (size_t band = 0; band < material.emission.size(); ++band) {
    check_emission(material.emission[band], "material", number, band);
    if (material.blocker && material.emission[band] > 0)
      fail(Status::argument, "material %lld is a blocker and can't emit: leave its emission 0",
           static_cast<long long>(number));
  }
  // What needs memory comes before all agree.
  material.reflectance.resize(bands, 0.5);
  material.emission.resize(bands, 0.0);
  scene_.materials.reserve(scene_.materials.size() + 1);
  comm_->all_go_on();
  return scene_.add_material(std::move(material));
}

void Solver::load_scene(const std::string& path) {
  const Stopwatch stopwatch(&stats_.seconds_load);
  require_open();
  if (scene_.bands != 1 && scene_.bands != 3)
    fail(Status::state,
         "parameter 'bands' is %d and %s has red, green and blue: set bands to 1 or 3 first",
         scene_.bands, path.c_str());
  const Sides sides = params_.sides == "two-sided" ? Sides::two_sided
                      : params_.sides == "flip"    ? Sides::flip
                                                   : Sides::front;
  SceneAddition addition(scene_);
  const size_t diagnostics = scene_.diagnostics.size();
  if (describes_scene()) {
    load_obj(scene_, path, sides);
    check_patches(scene_, addition.first_patch());
    check_memory(scene_, params_.max_memory);
  }
  broadcast(*comm_, scene_);
  // A log function that throws takes it back as well.
  warn(diagnostics);
  if (scene_.patch_count() > 0 && !any_emitter(scene_) && describes_scene())
    log_.write(Log::warning, no_emitter);
  comm_->all_go_on();
  addition.keep();
  set_up_axis();
}

void Solver::make_scene(const std::string& name) {
  const Stopwatch stopwatch(&stats_.seconds_load);
  require_open();
  if (scene_.patch_count() > 0 || !scene_.materials.empty())
    fail(Status::state,
         "the solver has %lld patches and %zu materials: a built-in scene needs an empty one",
         static_cast<long long>(scene_.patch_count()), scene_.materials.size());
  Scene made;
  made.bands = scene_.bands;
  make_builtin_scene(made, name);
  check_patches(made, 0);
  check_memory(made, params_.max_memory);
  std::swap(scene_, made);
  try {
    warn(0);
    comm_->all_go_on();
  } catch (...) {
    std::swap(scene_, made);
    throw;
  }
  set_up_axis();
}

// Rank 0's range of patches and the values given for each.
std::vector<double> Solver::values_of_patches(int64_t& first, int64_t& count,
                                              const double* given) const {
  std::vector<int64_t> range{first, count};
  broadcast(*comm_, range);
  first = range[0];
  count = range[1];
  check_patch_range(scene_, first, count);
  std::vector<double> values;
  if (describes_scene()) values.assign(given, given + count * scene_.bands);
  broadcast(*comm_, values);
  return values;
}

void Solver::set_emission(int64_t first, int64_t count, const double* given) {
  const std::vector<double> values = values_of_patches(first, count, given);
  const auto bands = static_cast<size_t>(scene_.bands);
  for (int64_t i = 0; i < count; ++i)
    for (size_t band = 0; band < bands; ++band) {
      const double value = values[static_cast<size_t>(i) * bands + band];
      check_emission(value, "patch", first + i, band);
      if (value > 0 && scene_.has(first + i, patch_blocker))
        fail(Status::state, "patch %lld is a blocker and can't emit: leave its emission 0",
             static_cast<long long>(first + i));
    }
  const size_t total = static_cast<size_t>(count) * bands;
  std::copy_n(values.begin(), total,
              scene_.emission.begin() + static_cast<ptrdiff_t>(first) * scene_.bands);
}

void Solver::set_reflectance(int64_t first, int64_t count, const double* given) {
  const std::vector<double> values = values_of_patches(first, count, given);
  const auto bands = static_cast<size_t>(scene_.bands);
  const size_t total = static_cast<size_t>(count) * bands;
  for (size_t i = 0; i < total; ++i)
    check_reflectance(values[i], "patch", first + static_cast<int64_t>(i / bands), i % bands);
  std::copy_n(values.begin(), total,
              scene_.reflectance.begin() + static_cast<ptrdiff_t>(first) * scene_.bands);
}

std::vector<std::string> Solver::diagnostics() const {
  std::vector<std::string> all = scene_.diagnostics;
  if (scene_.patch_count() > 0 && !any_emitter(scene_)) all.push_back(no_emitter);
  if (!solution_) return all;
  const Inspection& inspection = solution_->inspection;
  const Stats known = counts();
  // Measured more finely by a solve, but then only where light goes.
  const double back_share = std::max(inspection.back_share, known.back_share);
  if (back_share > kDoubtfulBackShare)
    all.push_back(
        format("%.1f %% of the rays that look for it meet the backs of one-sided patches: if these "
               "are the wrong way round or mean sheets, load with the parameter sides = flip or "
               "two-sided (hrad: --flip, --two-sided)",
               100 * back_share));
  if (inspection.unresolved)
    all.push_back(format(
        "%lld patches are smaller than what can be told apart in a scene of this size, %g %s "
        "(first: patch %lld): is there something far away that doesn't belong to it?",
        static_cast<long long>(inspection.unresolved), inspection.smallest, params_.unit.c_str(),
        static_cast<long long>(inspection.first_unresolved)));
  if (known.sealed_area > 0)
    all.push_back(
        format("%g of %g %s^2 of surface are sealed: pressed against another surface or "
               "inside a solid, they see nothing",
               known.sealed_area, known.area, params_.unit.c_str()));
  return all;
}

}  // namespace hrad
