// The solver apart from solving: the Initial Stage, the machine, counts and the hash.
// Floor 8 (solver).
#include "solver/solver.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "machine/comm_self.h"
#include "machine/crowd.h"
#include "machine/process_usage.h"
#include "machine/sharing.h"
#include "machine/topology.h"
#include "partition/partition.h"
#include "solver/export.h"
#include "solver/hash_of_own.h"
#include "solver/partition_plan.h"
#include "solver/same_everywhere.h"
#include "solver/solution.h"
#include "solver/team_report.h"
#include "stages/state_memory.h"

namespace hrad {
namespace {

// Links of clusters are held by all processes, and are one's own.
int64_t links_of_others(const State& state, const Exchange& exchange) {
  int64_t count = 0;
  for (NodeId id = static_cast<NodeId>(state.forest.surface_count());
       id < static_cast<NodeId>(state.forest.surface_count() +
                                static_cast<int64_t>(state.forest.clusters.clusters.size()));
       ++id)
    if (!exchange.mine(state.forest, id)) count += state.links[static_cast<size_t>(id)].count();
  return count;
}

// Which steps the stages make; another number for others, whose results mean something else.
constexpr uint64_t steps_of_stages = 4;

// What a ray engine takes for a patch while it is built.
constexpr int64_t kEngineBytesOfPatch = 150;

}  // namespace

uint64_t hash_of_light(const Scene& scene) {
  Hasher hash;
  for (double value : scene.emission) hash.add(value);
  for (double value : scene.reflectance) hash.add(value);
  return hash.value();
}

uint64_t hash_of_linking(const Params& params, uint64_t light, double scale) {
  Hasher hash;
  hash.add(steps_of_stages);
  hash.add(light);
  hash.add(scale);
  for (const ParamRow& row : param_table())
    if (row.is_result) hash.add(param_text(params, row).c_str());
  return hash.value();
}

Solver::Solver() : Solver(std::make_shared<CommSelf>()) {}
Solver::Solver(std::shared_ptr<Comm> comm) : comm_(std::move(comm)) {}
Solver::~Solver() = default;

void Solver::partition() {
  if (solution_) return;
  if (scene_.patch_count() == 0)
    fail(Status::scene, "the scene has no patches: load, make or add some before solving");
  const auto start = std::chrono::steady_clock::now();
  check_same_everywhere(*comm_, params_, scene_);
  auto solution = std::make_unique<Solution>(scene_);
  MemoryBudget& memory = solution->state.memory;
  memory.set_limit(params_.max_memory);
  memory.take(scene_.bytes(), "the patches of the scene");
  memory.take(bytes_of(solution->state), "the elements of the patches");
  // Until its true size is known.
  const int64_t expected = scene_.patch_count() * kEngineBytesOfPatch;
  memory.take(expected, "the structure for rays");
  start_team(*solution);
  solution->engine =
      make_visibility_engine(scene_, params_.visibility, params_.instruction_set, *solution->team);
  memory.take(solution->engine->bytes() - expected, "the structure for rays");
  solution->exposure = std::make_unique<Exposure>(scene_, *solution->engine);
  solution->inspection = inspect(scene_, *solution->engine, *solution->exposure);
  deal_out(*solution);
  comm_->all_go_on();  // or the scene stays open on all
  solution_ = std::move(solution);
  stats_.seconds_initial +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void Solver::start_team(Solution& solution) const {
  const Topology topology = read_topology();
  const PoolPlan plan = plan_pool(topology, params_.threads, params_.smt != 0, params_.bind != 0,
                                  sharers_of_processors(*comm_, topology));
  report_teams(*comm_, topology, plan, log_);
  if (plan.threads > 1 && !comm_->threads_ok())
    log_.write(Log::warning,
               format("MPI was started for programs of one thread and the solver starts %d: call "
                      "MPI_Init_thread with MPI_THREAD_FUNNELED, or set the parameter threads to 1",
                      plan.threads));
  solution.team = std::make_unique<ThreadTeam>(plan.threads, plan.binding);
  solution.team->set_observer(observer_);
}

// Gives every patch an owner.
void Solver::deal_out(Solution& solution) const {
  const std::vector<Surface>& surfaces = solution.state.forest.surfaces;
  std::vector<int32_t> of_surface(surfaces.size(), 0);
  if (!comm_->alone()) {
    const std::vector<PartitionItem> items = partition_items(
        scene_, predicted_work(params_, solution.state, solution.inspection, *solution.exposure));
    const std::vector<int32_t> owners =
        owners_of(scene_, items, partition_method(params_.partition).divide(items, comm_->size()));
    for (size_t k = 0; k < surfaces.size(); ++k)
      of_surface[k] = owners[static_cast<size_t>(surfaces[k].patch)];
  }
  solution.exchange = std::make_unique<Exchange>(*comm_, std::move(of_surface));
}

int32_t Solver::patch_owner(int64_t patch) const {
  if (!solution_) fail(Status::state, "no patch has an owner yet: call hrad_partition first");
  // Who exchanges no light is nobody's work.
  const NodeId root = solution_->state.forest.root(patch, 0);
  return root < 0 ? 0 : solution_->exchange->owner(root);
}

PartitionPlan Solver::plan_partition(const std::string& method, int32_t ranks) {
  static_cast<void>(partition_method(method));  // what can't be done closes no scene
  partition();
  return hrad::plan_partition(
      solution_->state, *solution_->engine,
      predicted_work(params_, solution_->state, solution_->inspection, *solution_->exposure),
      method, ranks);
}

void Solver::export_partition(const std::string& method, int32_t ranks, const std::string& path) {
  check_partition_file(path);
  hrad::export_partition(scene_, plan_partition(method, ranks), path);
}

std::string Solver::describe_machine() const {
  const Topology topology = read_topology();
  return describe(topology,
                  plan_pool(topology, params_.threads, params_.smt != 0, params_.bind != 0));
}

// What each process did, added up; memory is that of the one which needed most.
Stats Solver::stats() const {
  measure_if_due();
  Stats all = counts();
  std::vector<Stats> of_each{all};
  unite(*comm_, of_each);
  all.rays = all.pairs = all.links = all.swept_links = 0;
  all.cpu_seconds = 0;
  for (int kind = 0; kind < 3; ++kind) all.messages[kind] = all.message_bytes[kind] = 0;
  for (const Stats& s : of_each) {
    all.rays += s.rays;
    all.pairs += s.pairs;
    all.links += s.links;
    all.swept_links += s.swept_links;
    all.cpu_seconds += s.cpu_seconds;
    all.memory_peak_bytes = std::max(all.memory_peak_bytes, s.memory_peak_bytes);
    all.link_bytes = std::max(all.link_bytes, s.link_bytes);
    all.node_bytes = std::max(all.node_bytes, s.node_bytes);
    for (int kind = 0; kind < 3; ++kind) {
      all.messages[kind] += s.messages[kind];
      all.message_bytes[kind] += s.message_bytes[kind];
    }
  }
  return all;
}

Stats Solver::counts() const {
  Stats s = stats_;
  s.patches = scene_.patch_count();
  s.ranks = comm_->size();
  s.up_axis = scene_.z_up ? 2 : params_.up == "y" ? 1 : 0;
  s.memory_peak_bytes = peak_memory();
  if (!solution_) return s;
  const Solution& solution = *solution_;
  const State& state = solution.state;
  s.threads = solution.team->size();
  s.elements = static_cast<int64_t>(state.forest.nodes.size());
  s.leaves = state.forest.leaf_count();
  s.rays = state.rays;
  s.pairs = state.pairs;
  s.swept_links = state.links.link_count() + state.direct.mean.link_count() -
                  links_of_others(state, *solution.exchange);
  s.links = s.swept_links + static_cast<int64_t>(state.direct.links.size());
  for (int kind = 0; kind < 3; ++kind) {
    s.messages[kind] = solution.exchange->counts().messages[kind];
    s.message_bytes[kind] = solution.exchange->counts().bytes[kind];
  }
  s.link_bytes = bytes_of_links(state);
  s.node_bytes = bytes_of_nodes(state);
  s.area = s.sealed_area = 0;
  for (size_t k = 0; k < state.forest.surfaces.size(); ++k) {
    s.area += state.forest.surfaces[k].area;
    s.sealed_area += state.forest.surfaces[k].area * (1 - state.forest.nodes[k].exposed);
  }
  s.back_share = solution.balance.back_share;
  return s;
}

namespace {

void add(Hasher& hash, Span<const Link> links) {
  hash.add(static_cast<uint64_t>(links.size()));
  for (const Link& link : links) {
    hash.add(static_cast<uint64_t>(link.source));
    hash.add(link.weight);
  }
}

// Of an element or cluster with its links and its light.
uint64_t hash_of_node(const State& state, NodeId id) {
  const Node& node = state.forest.nodes[id];
  const size_t at = static_cast<size_t>(id);
  Hasher hash;
  hash.add(key_of(state.forest, node));
  hash.add(static_cast<uint64_t>(node.first_child + 1));
  hash.add(node.exposed);
  hash.add(static_cast<uint64_t>(node.light_points));
  add(hash, state.links[at].links());
  const CornerLight& direct = state.direct;
  if (at < direct.mean.size()) add(hash, direct.mean[at].links());
  // Numbers of points are a matter of who numbers them: what they say is not.
  if (at < direct.of_leaf.size() && direct.of_leaf[at][0] >= 0) {
    for (int32_t point : direct.of_leaf[at]) add(hash, direct.links_of_point(point));
    if (const LeafPoints::Places* own = direct.of_leaf.own_places(at))
      for (const LeafPoints::Place& place : *own) {
        hash.add(place.x);
        hash.add(place.y);
      }
  }
  for (int band = 0; band < state.bands; ++band) hash.add(state.radiosity_of(id)[band]);
  return hash.value();
}

}  // namespace

uint64_t Solver::state_hash() const {
  require_solved();
  const State& state = solution_->state;
  Hasher hash;
  for (const ParamRow& row : param_table())
    if (row.is_result) {
      hash.add(row.name);
      hash.add(param_text(params_, row).c_str());
    }
  hash.add(static_cast<uint64_t>(scene_.patch_count()));
  for (int64_t patch = 0; patch < scene_.patch_count(); ++patch) {
    const Triangle t = scene_.triangle(patch);
    for (const Vec3& p : {t.a, t.b, t.c})
      for (int axis = 0; axis < 3; ++axis) hash.add(p[axis]);
    hash.add(static_cast<uint64_t>(scene_.flags[patch]));
  }
  for (double value : scene_.emission) hash.add(value);
  for (double value : scene_.reflectance) hash.add(value);
  hash.add(
      hash_of_own(state, *solution_->exchange, [&](NodeId id) { return hash_of_node(state, id); }));
  return hash.value();
}

void Solver::export_file(const std::string& path) const {
  const auto start = std::chrono::steady_clock::now();
  if (!comm_->alone()) {
    std::vector<uint8_t> needs{needs_solution(path)};  // rank 0's path counts
    broadcast(*comm_, needs);
    if (needs[0]) {
      require_solved();
      prepare_leaves();  // by all of them
      reconstruction();
    }
  }
  if (comm_->rank() == 0) export_solution(*this, path);
  comm_->all_go_on();
  stats_.seconds_output +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace hrad
