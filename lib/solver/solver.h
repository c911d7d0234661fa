// The solver: scene, parameters and solution of one radiosity problem, and the order of its stages
// (paper, Fig. 1). Every entry of the C API is one method here. Floor 8 (solver).
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/log.h"
#include "base/vec3.h"
#include "machine/comm.h"
#include "machine/file_lock.h"
#include "machine/work_observer.h"
#include "scene/scene.h"
#include "solver/params.h"
#include "solver/stats.h"

namespace hrad {

struct Progress {
  const char* stage = "";
  int64_t iteration = 0;
  double fraction = 0, seconds = 0, seconds_left = -1;
  double stage_share = 0;  // of the stage that is under way, as it counts itself
};

// One leaf, as queries and exports see it.
struct LeafView {
  int64_t patch = 0, face = 0;
  int32_t side = 0;  // 0 front, 1 back
  Triangle corners;  // anticlockwise seen from the leaf's side
  double area = 0;
  double exposed = 1;  // share of the area that is not sealed
};

enum class Quantity : int32_t { radiosity = 0, irradiance = 1, emission = 2, net_flux = 3 };

class Solver {
 public:
  Solver();
  // One of the processes that solve together; those of other solvers don't hear of it.
  explicit Solver(std::shared_ptr<Comm> comm);
  ~Solver();
  Comm& comm() const { return *comm_; }

  // parameters
  void set_int(const std::string& name, int64_t value);
  void set_double(const std::string& name, double value);
  void set_text(const std::string& name, const std::string& value);
  const Params& params() const { return params_; }
  Log& log() { return log_; }
  // sink returns false to stop the solve at the next safe point. Called on the thread of solve().
  void set_progress(std::function<bool(const Progress&)> sink) { progress_ = std::move(sink); }
  // Tells an observer, which must outlive this, of stages and loops; before partition().
  void set_observer(WorkObserver* observer) { observer_ = observer; }

  // load: collective; what describes the scene is taken from rank 0's arguments, whatever those of
  // the others are
  bool describes_scene() const { return comm_->rank() == 0; }
  int32_t add_material(Material material);
  void add_patches(int64_t n_vertices, const double* xyz, int64_t n_triangles,
                   const int64_t* vertex, const int32_t* material);
  void load_scene(const std::string& path);
  void make_scene(const std::string& name);
  void set_emission(int64_t first, int64_t count, const double* values);
  void set_reflectance(int64_t first, int64_t count, const double* values);
  const Scene& scene() const { return scene_; }
  std::vector<std::string> diagnostics() const;

  // partition and machine
  void partition();
  bool partitioned() const { return solution_ != nullptr; }
  int32_t patch_owner(int64_t patch) const;  // of a patch that is there
  // What so many ranks would get by a method, "grid" or "cost"; partition() comes first.
  struct PartitionPlan plan_partition(const std::string& method, int32_t ranks);
  void export_partition(const std::string& method, int32_t ranks, const std::string& path);
  std::string describe_machine() const;

  // solve
  Status solve();
  void request_stop() { stop_requested_.store(true, std::memory_order_relaxed); }
  Stats stats() const;
  uint64_t state_hash() const;

  // query, of arguments that the caller has checked; STATE before a solve
  bool solved() const;
  void query_patches(Quantity quantity, int32_t side, int64_t first, int64_t count,
                     double* out) const;
  void query_points(Quantity quantity, int32_t side, int64_t count, const int64_t* patch,
                    const double* uv, double* out) const;
  void query_sensors(int64_t count, const double* xyz, const double* normal, double* irradiance,
                     double* standard_error) const;
  int64_t leaf_count() const;
  // Collective, before any process looks at leaves.
  void prepare_leaves() const;
  LeafView leaf(int64_t index) const;                                     // in key order
  void leaf_values(int64_t index, Quantity quantity, double* out) const;  // means, bands values
  // Linear reconstruction of radiosity at the three corners of a leaf: 3*bands values.
  void leaf_corner_radiosity(int64_t index, double* out) const;
  // Numbers that name these corners: leaves of one side of a patch that meet at a corner have the
  // same number there, and the same radiosity unless one of them is sealed.
  std::array<int32_t, 3> leaf_corner_numbers(int64_t index) const;
  void power_balance(double* emitted, double* absorbed, double* absorbed_back,
                     double* escaped) const;

  // files
  // A lock that keeps other writers of this checkpoint away until another path is locked or the
  // solver goes.
  void lock_checkpoint(const std::string& path);
  // Also from within the progress function: the state between two sweeps or before the round of
  // refinement that is under way.
  void write_checkpoint(const std::string& path);
  // Replaces scene, result parameters and solution, or nothing of them. STATE: the solver has
  // another scene.
  void read_checkpoint(const std::string& path);
  void export_file(const std::string& path) const;

 private:
  struct Solution;
  class Run;
  void start_team(Solution& solution) const;
  void deal_out(Solution& solution) const;
  void require_solved() const;
  void measure_if_due() const;
  Stats counts() const;  // stats() with what has been measured already
  // Of the answers that are kept for queries. Those but the first are collective.
  const std::vector<int32_t>& leaves() const;
  const class LightOfAll& radiosity_of_all() const;
  const class LightOfAll& irradiance_of_all() const;
  const class Reconstruction& reconstruction() const;
  void require_open() const;  // the scene may still grow
  void set_up_axis();         // of a scene that has just changed, where the parameter says
  void check_counts(int64_t n_vertices, int64_t n_triangles) const;
  void add_patches_here(int64_t n_vertices, const double* xyz, int64_t n_triangles,
                        const int64_t* vertex, const int32_t* material);
  std::vector<double> values_of_patches(int64_t& first, int64_t& count, const double* given) const;
  void warn(size_t before) const;
  void take_over(struct CheckpointContent& content);
  std::unique_ptr<struct CheckpointContent> read_on_all_ranks(const std::string& path) const;

  const std::shared_ptr<Comm> comm_;
  Params params_;
  Log log_;
  std::function<bool(const Progress&)> progress_;
  WorkObserver* observer_ = nullptr;
  Scene scene_;
  mutable Stats stats_;
  std::atomic<bool> stop_requested_{false};
  std::unique_ptr<Solution> solution_;  // from partition() on
  std::unique_ptr<FileLock> checkpoint_lock_;
  // solve() was entered with a valid scene: result parameters hold from then on.
  bool begun_ = false;
  bool solving_ = false;  // the team is at work
};

}  // namespace hrad
