// Patches handed in as arrays, by rank 0 for all. Floor 8 (solver).
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "machine/sharing.h"
#include "scene/load.h"
#include "solver/scene_addition.h"
#include "solver/solution.h"

namespace hrad {
namespace {

// Coordinates beyond this would overflow when areas are multiplied.
constexpr double kLargestCoordinate = 1e30;
// Patches and vertices are named by 32-bit indices.
constexpr int64_t kMostPatches = std::numeric_limits<int32_t>::max();

// The arrays of a call, on their way to the other ranks.
struct GivenPatches {
  std::vector<double> xyz;
  std::vector<int64_t> vertex;
  std::vector<int32_t> material;  // none: the call had none

  GivenPatches() = default;
  GivenPatches(int64_t n_vertices, const double* xyz, int64_t n_triangles, const int64_t* vertex,
               const int32_t* material)
      : xyz(xyz, xyz + 3 * n_vertices), vertex(vertex, vertex + 3 * n_triangles) {
    if (material) this->material.assign(material, material + n_triangles);
  }
  void broadcast(Comm& comm) {
    hrad::broadcast(comm, xyz);
    hrad::broadcast(comm, vertex);
    hrad::broadcast(comm, material);
  }
};

}  // namespace

void Solver::add_patches(int64_t n_vertices, const double* xyz, int64_t n_triangles,
                         const int64_t* vertex, const int32_t* material) {
  const Stopwatch stopwatch(&stats_.seconds_load);
  require_open();
  if (comm_->alone()) {
    add_patches_here(n_vertices, xyz, n_triangles, vertex, material);
    return;
  }
  GivenPatches given;
  if (describes_scene()) {
    check_counts(n_vertices, n_triangles);
    given = GivenPatches(n_vertices, xyz, n_triangles, vertex, material);
  }
  given.broadcast(*comm_);
  add_patches_here(static_cast<int64_t>(given.xyz.size() / 3), given.xyz.data(),
                   static_cast<int64_t>(given.vertex.size() / 3), given.vertex.data(),
                   given.material.empty() ? nullptr : given.material.data());
}

// Before the arrays are touched it is known that they can be that long.
void Solver::check_counts(int64_t n_vertices, int64_t n_triangles) const {
  const auto vertices = static_cast<int64_t>(scene_.vertices.size());
  if (n_vertices > kMostPatches - vertices || n_triangles > kMostPatches - scene_.patch_count())
    fail(Status::argument,
         "%lld more vertices and %lld more triangles are too many: a scene has up to %lld of each",
         static_cast<long long>(n_vertices), static_cast<long long>(n_triangles),
         static_cast<long long>(kMostPatches));
}

void Solver::add_patches_here(int64_t n_vertices, const double* xyz, int64_t n_triangles,
                              const int64_t* vertex, const int32_t* material) {
  check_counts(n_vertices, n_triangles);
  for (int64_t i = 0; i < 3 * n_vertices; ++i)
    if (!(std::fabs(xyz[i]) <= kLargestCoordinate))
      fail(Status::argument,
           "vertex %lld has the coordinate %g: coordinates must be finite and within +-%g",
           static_cast<long long>(i / 3), xyz[i], kLargestCoordinate);
  for (int64_t i = 0; i < 3 * n_triangles; ++i)
    if (vertex[i] < 0 || vertex[i] >= n_vertices)
      fail(Status::argument, "triangle %lld has the vertex %lld: this call has %lld, from 0 on",
           static_cast<long long>(i / 3), static_cast<long long>(vertex[i]),
           static_cast<long long>(n_vertices));
  const auto materials = static_cast<int64_t>(scene_.materials.size());
  for (int64_t i = 0; material && i < n_triangles; ++i)
    if (material[i] < 0 || material[i] >= materials)
      fail(Status::argument, "triangle %lld has the material %d: there are %lld, from 0 on",
           static_cast<long long>(i), static_cast<int>(material[i]),
           static_cast<long long>(materials));
  if (n_triangles == 0) return;

  const auto base = static_cast<int64_t>(scene_.vertices.size());
  SceneAddition addition(scene_);
  const size_t diagnostics = scene_.diagnostics.size();
  if (!material && materials == 0) {
    Material gray;  // its missing values are reflectance 0.5 and emission 0
    gray.name = "default";
    scene_.add_material(std::move(gray));
  }
  for (int64_t i = 0; i < n_vertices; ++i)
    scene_.add_vertex({xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]});
  const auto corner = [&](int64_t i) { return static_cast<int32_t>(base + vertex[i]); };
  for (int64_t i = 0; i < n_triangles; ++i)
    scene_.add_patch(corner(3 * i), corner(3 * i + 1), corner(3 * i + 2),
                     material ? material[i] : 0);
  check_patches(scene_, addition.first_patch());
  check_memory(scene_, params_.max_memory);
  warn(diagnostics);
  comm_->all_go_on();
  addition.keep();
  // As engineers have it; files of pictures have y.
  if (addition.first_patch() == 0) scene_.z_up = true;
  set_up_axis();
}

}  // namespace hrad
