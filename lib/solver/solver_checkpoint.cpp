// The solver's way into a checkpoint and back. Floor 8 (solver).
#include <chrono>
#include <utility>

#include "base/error.h"
#include "machine/file_self.h"
#include "machine/shared_file.h"
#include "solver/all_points.h"
#include "solver/checkpoint.h"
#include "solver/checkpoint_scene.h"
#include "solver/own_links.h"
#include "solver/solution.h"
#include "stages/state_memory.h"

namespace hrad {
namespace {

// The result parameters of the file and the run parameters of the solver.
Params joined(const Params& of_file, const Params& here) {
  Params params = here;
  for (const ParamRow& row : param_table()) {
    if (!row.is_result) continue;
    if (row.as_int) params.*row.as_int = of_file.*row.as_int;
    if (row.as_double) params.*row.as_double = of_file.*row.as_double;
    if (row.as_text) params.*row.as_text = of_file.*row.as_text;
  }
  return params;
}

// What all ranks have counted.
void add_up(Comm& comm, int64_t& rays, int64_t& pairs) {
  uint64_t sums[] = {static_cast<uint64_t>(rays), static_cast<uint64_t>(pairs)};
  comm.add_up({sums, 2});
  rays = static_cast<int64_t>(sums[0]);
  pairs = static_cast<int64_t>(sums[1]);
}

// What this process is to write: rank 0 what all have from a file, each what it has done itself.
Span<const LinkStep> own_steps(const LinkJournal& journal, const Comm& comm) {
  const Span<const LinkStep> all = journal.steps();
  const size_t first = comm.rank() == 0 ? 0 : journal.restored_steps();
  return all.subspan(first, all.size() - first);
}

}  // namespace

void Solver::lock_checkpoint(const std::string& path) {
  std::unique_ptr<FileLock> lock;
  if (comm_->rank() == 0 && !(checkpoint_lock_ && checkpoint_lock_->is_of(path)))
    lock = std::make_unique<FileLock>(path);
  comm_->all_go_on();
  if (lock) checkpoint_lock_ = std::move(lock);
}

void Solver::write_checkpoint(const std::string& path) {
  const auto start = std::chrono::steady_clock::now();
  if (solving_ && !comm_->alone())
    fail(Status::state,
         "%s: the progress function is called on one rank, and all must write together: stop the "
         "solve there, write, and solve on",
         path.c_str());
  const SolveProgress no_progress;
  const LinkJournal no_journal;
  const PowerBalance no_balance;
  const Inspection no_inspection;
  const Solution* s = solution_.get();
  const SolveProgress* progress = s ? static_cast<const SolveProgress*>(s) : &no_progress;
  const LinkJournal& journal = s ? s->state.journal : no_journal;
  const bool linked = s && s->linked;
  // What linking that is under way has counted it will count again.
  int64_t rays = linked ? s->state.rays : journal.rays_before;
  if (solving_ && !linked && journal.empty())
    fail(Status::state, "%s: nothing is linked yet that a checkpoint could keep", path.c_str());
  int64_t pairs = linked ? s->state.pairs : journal.pairs_before;
  add_up(*comm_, rays, pairs);
  std::unique_ptr<FileLock> lock;
  if (comm_->rank() == 0 && !(checkpoint_lock_ && checkpoint_lock_->is_of(path)))
    lock = std::make_unique<FileLock>(path);
  SharedFile file(*comm_, path);
  std::unique_ptr<AllPoints> points;
  std::unique_ptr<LightOfAll> radiosity, irradiance;
  if (linked) {
    State& state = solution_->state;
    points = std::make_unique<AllPoints>(state, *s->exchange);
    radiosity = std::make_unique<LightOfAll>(state, &State::radiosity, *s->exchange, *s->team);
    irradiance = std::make_unique<LightOfAll>(state, &State::irradiance, *s->exchange, *s->team);
  }
  hrad::write_checkpoint(
      *comm_, file,
      {params_, scene_, begun_, linked ? &s->state : nullptr, linked ? s->exchange.get() : nullptr,
       points.get(), radiosity.get(), irradiance.get(), own_steps(journal, *comm_), journal.key(),
       rays, pairs, *progress, stats_, s ? s->balance : no_balance,
       s ? s->inspection : no_inspection},
      s && !solving_ ? s->team.get() : nullptr);
  file.commit_keeping(static_cast<int>(params_.checkpoint_keep));
  stats_.seconds_output +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Builds what is not in the file, and puts what was read in place.
void Solver::take_over(CheckpointContent& content) {
  partition();
  Solution& s = *solution_;
  static_cast<SolveProgress&>(s) = content.progress;
  // What a ray takes is known of this machine alone.
  content.inspection.seconds_of_a_ray = s.inspection.seconds_of_a_ray;
  s.inspection = content.inspection;
  s.balance = std::move(content.balance);
  State& state = s.state;
  // Counts are added up over all ranks.
  state.rays = comm_->rank() == 0 ? content.rays : 0;
  state.pairs = comm_->rank() == 0 ? content.pairs : 0;
  counted(state, [&] {
    state.journal = LinkJournal::restored(content.key_of_steps, state.rays, state.pairs,
                                          std::move(content.steps));
    if (!content.state) return;
    state.forest = std::move(content.state->forest);
    state.forest.scene = &scene_;
    state.links = std::move(content.state->links);
    state.cells = std::move(content.state->cells);
    state.direct = std::move(content.state->direct);
    keep_own_links(state, *s.exchange, *s.team);
    s.exchange->forget(state);
    s.exchange->keep_own_light(state, content.state->radiosity.data(),
                               content.state->irradiance.data());
    s.exchange->ask_for_sources(state, *s.team);
  });
}

// Rank 0 alone opens the file.
std::unique_ptr<CheckpointContent> Solver::read_on_all_ranks(const std::string& path) const {
  std::string text;
  if (comm_->rank() == 0 && !read_file(path, text))
    fail(Status::file, "%s: there is no such file", path.c_str());
  Bytes bytes(text.begin(), text.end());
  comm_->broadcast(bytes);
  text.assign(bytes.begin(), bytes.end());
  return read_checkpoint_bytes(path, text, params_.max_memory);
}

void Solver::read_checkpoint(const std::string& path) {
  const auto start = std::chrono::steady_clock::now();
  const std::unique_ptr<CheckpointContent> content =
      comm_->alone() ? read_checkpoint_file(path, params_.max_memory) : read_on_all_ranks(path);
  if (scene_.patch_count() > 0) {
    const std::string difference = difference_of(content->scene, scene_);
    if (!difference.empty())
      fail(Status::state, "%s is the checkpoint of another scene: %s", path.c_str(),
           difference.c_str());
  }
  const bool begun = content->begun;
  Params params = joined(content->params, params_);
  // What is here now comes back when the rest fails.
  std::unique_ptr<Solution> solution = std::move(solution_);
  std::swap(scene_, content->scene);
  std::swap(params_, params);
  const Stats stats = std::exchange(stats_, content->stats);
  try {
    if (begun) take_over(*content);
    comm_->all_go_on();
  } catch (const std::exception& error) {
    solution_ = std::move(solution);
    std::swap(scene_, content->scene);
    std::swap(params_, params);
    stats_ = stats;
    const auto* known = dynamic_cast<const Error*>(&error);
    // A scene that can't be partitioned is no scene that a solver writes.
    if (known && known->status() == Status::scene)
      fail(Status::format, "%s: section 'patches': %s", path.c_str(), known->what());
    throw;
  }
  begun_ = begun;
  set_up_axis();
  stats_.seconds_load =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace hrad
