// Requests and updates: an element's radiosity is asked for once, by who links to it, and told
// again in every sweep without being asked.
#include <algorithm>
#include <vector>

#include "stages/exchange.h"
#include "stages/gather.h"
#include "stages/light_of_all.h"
#include "support/thread_ranks.h"
#include "support/workbench.h"

namespace {

using namespace hrad;
using namespace hrad_test;

constexpr int ranks = 3;

int32_t owner_of(NodeId surface) { return surface % ranks; }

std::vector<int32_t> owners_of(const State& state) {
  std::vector<int32_t> owners;
  for (NodeId k = 0; k < state.forest.surface_count(); ++k) owners.push_back(owner_of(k));
  return owners;
}

// What a rank has of a scene whose patches are divided so often.
struct Part {
  Part(const Scene& scene, Comm& comm, int level) : state(scene), exchange(comm, owners_of(state)) {
    split_all(state.forest, level);
    exchange.make_room_for_light(state);
  }
  State state;
  ThreadTeam team{2};
  Exchange exchange;
};

// The first root of each rank is linked to these.
void link_to(State& state, int rank, const std::vector<NodeId>& sources) {
  std::vector<Link> links;
  for (NodeId source : sources) links.push_back({source, 0.5f});
  state.links.resize(state.forest.nodes.size());
  state.links.replace({{static_cast<NodeId>(rank), links}});
}

void elements_are_asked_for_once() {
  const Scene scene = builtin_scene("cornell");
  std::vector<MessageCounts> counts[4];
  std::vector<float> seen(ranks, 0);
  for (auto& of_rank : counts) of_rank.resize(ranks);
  on_ranks(ranks, [&](Comm& comm) {
    State state(scene);
    ThreadTeam team(2);
    const int rank = comm.rank();
    split_all(state.forest, 1);
    // The children of surface k, which know whose they are.
    const auto child = [&](NodeId surface, int k) {
      return state.forest.nodes[surface].first_child + k;
    };
    Exchange exchange(comm, owners_of(state));
    exchange.make_room_for_light(state);
    const auto shine = [&](int turn) {
      for (NodeId k = 0; k < static_cast<NodeId>(state.forest.nodes.size()); ++k)
        if (exchange.mine(state.forest, k))
          state.radiosity_of(k)[0] = static_cast<float>(k + 1000 * turn);
    };
    shine(-1);
    const NodeId next = (rank + 1) % ranks, last = (rank + 2) % ranks;
    const auto ask = [&](int turn) {
      exchange.ask_for_sources(state, team);
      counts[turn][static_cast<size_t>(rank)] = exchange.counts();
    };
    // A root, an own element, two of the next rank and one of that after it.
    link_to(state, rank, {next, child(rank, 0), child(next, 0), child(next, 1), child(last, 2)});
    ask(0);
    const auto at = [&](NodeId id) { return state.radiosity_of(id)[0]; };
    bool right = at(child(next, 1)) == static_cast<float>(child(next, 1) - 1000) &&
                 at(child(last, 2)) == static_cast<float>(child(last, 2) - 1000);
    ask(1);  // nothing new
    link_to(state, rank, {child(next, 1), child(next, 3), child(last, 2)});
    ask(2);
    for (int sweep = 0; sweep < 3; ++sweep) {
      shine(sweep);
      exchange.start_update(state, team);
      exchange.finish_update(state, team);
    }
    counts[3][static_cast<size_t>(rank)] = exchange.counts();
    for (NodeId id : {next, child(next, 0), child(next, 1), child(next, 3), child(last, 2)})
      right = right && at(id) == static_cast<float>(id + 2000);
    seen[static_cast<size_t>(rank)] = right && at(child(next, 2)) == 0 ? 1.0f : 0.0f;
  });
  const auto id_bytes = static_cast<int64_t>(sizeof(NodeId));
  for (size_t rank = 0; rank < ranks; ++rank) {
    CHECK_EQUAL(counts[0][rank].messages[0], 2);
    CHECK_EQUAL(counts[0][rank].bytes[0], 4 * id_bytes);
    CHECK_EQUAL(counts[1][rank].messages[0], 2);
    CHECK_EQUAL(counts[2][rank].messages[0], 3);
    CHECK_EQUAL(counts[2][rank].bytes[0], 5 * id_bytes);
    // Every request is answered once, and updates go to two ranks in each of three sweeps: five
    // elements of three bands.
    const auto element_bytes = static_cast<int64_t>(3 * sizeof(float));
    CHECK_EQUAL(counts[2][rank].messages[1], 3);
    CHECK_EQUAL(counts[2][rank].bytes[1], 5 * element_bytes);
    CHECK_EQUAL(counts[3][rank].messages[0], 3);
    CHECK_EQUAL(counts[3][rank].messages[1], 3 + 6);
    CHECK_EQUAL(counts[3][rank].bytes[1], (1 + 3) * 5 * element_bytes);
    CHECK(seen[rank] == 1.0f);
  }
}

// Of two receivers one has an own source, the other one that its owner tells of: the first is
// gathered for while messages fly, the second when they have come.
void what_needs_no_message_does_not_wait() {
  const Scene scene = builtin_scene("cornell");
  std::vector<uint8_t> right(ranks, 0);
  on_ranks(ranks, [&](Comm& comm) {
    Part part(scene, comm, 1);
    State& state = part.state;
    ThreadTeam& team = part.team;
    Exchange& exchange = part.exchange;
    const NodeId here = comm.rank(), waiting = here + ranks, next = (here + 1) % ranks;
    const Link own{state.forest.nodes[here].first_child, 0.5f};
    const Link of_next{state.forest.nodes[next].first_child, 0.25f};
    state.links.resize(state.forest.nodes.size());
    state.links.replace({{here, {&own, 1}}, {waiting, {&of_next, 1}}});
    exchange.ask_for_sources(state, team);
    const OwnRuns runs(state, exchange, team);
    const auto irradiance = [&](NodeId id) { return state.irradiance_of(id)[0]; };
    state.radiosity_of(own.source)[0] = static_cast<float>(here + 1);
    std::fill(state.irradiance.begin(), state.irradiance.end(), 7.0f);
    exchange.start_update(state, team);
    gather_what_is_here(state, team, runs, exchange);
    bool all = !runs.all() && runs.blocks().size() == 1 &&
               runs.blocks()[0].of_table(0, true).size() == 1 &&
               irradiance(here) == 0.5f * static_cast<float>(here + 1) && irradiance(waiting) == 0;
    exchange.finish_update(state, team);
    exchange.finish_update(state, team);  // there is none any more
    gather_what_has_come(state, team, runs);
    all = all && irradiance(here) == 0.5f * static_cast<float>(here + 1) &&
          irradiance(waiting) == 0.25f * static_cast<float>(next + 1);
    right[static_cast<size_t>(comm.rank())] = all;
  });
  for (uint8_t r : right) CHECK(r);
}

// Numbers whose sum depends on the order in which doubles are added.
void totals_are_exact() {
  const double values[ranks] = {1e16, 1, -1e16};
  std::vector<double> sums(2 * ranks, 0.0);
  std::vector<MessageCounts> counts(ranks);
  on_ranks(ranks, [&](Comm& comm) {
    const size_t rank = static_cast<size_t>(comm.rank());
    Exchange exchange(comm, {0, 1, 2});
    std::vector<ExactSum> totals(2);
    totals[0].add(values[rank]);
    totals[1].add(0.5);
    exchange.add_up_transported(totals);
    for (size_t b = 0; b < 2; ++b) sums[2 * rank + b] = totals[b].value();
    counts[rank] = exchange.counts();
  });
  for (size_t rank = 0; rank < ranks; ++rank) {
    CHECK_EQUAL(sums[2 * rank], 1.0);
    CHECK_EQUAL(sums[2 * rank + 1], 1.5);
    CHECK_EQUAL(counts[rank].messages[2], 2);
    CHECK_EQUAL(counts[rank].bytes[2], static_cast<int64_t>(2 * 2 * sizeof(ExactSum::Digits)));
  }
}

// Once for all, where no process asks.
void roots_are_shared() {
  const Scene scene = builtin_scene("cornell");
  std::vector<uint8_t> right(ranks, 0);
  on_ranks(ranks, [&](Comm& comm) {
    State state(scene);
    const std::vector<int32_t> owner = owners_of(state);
    Exchange exchange(comm, owner);
    exchange.make_room_for_light(state);
    const size_t bands = static_cast<size_t>(state.bands);
    for (size_t k = 0; k < owner.size(); ++k)
      if (exchange.mine(static_cast<NodeId>(k))) {
        state.radiosity[k * bands] = static_cast<float>(k + 1);
        state.irradiance[k * bands] = static_cast<float>(2 * k + 1);
      }
    ThreadTeam team(2);
    exchange.share_roots(state, team);
    bool all = true;
    for (size_t k = 0; k < owner.size(); ++k)
      all = all && state.radiosity[k * bands] == static_cast<float>(k + 1) &&
            state.irradiance[k * bands] == static_cast<float>(2 * k + 1);
    right[static_cast<size_t>(comm.rank())] = all;
  });
  for (uint8_t r : right) CHECK(r);
}

// A process keeps the light of what is its own or asked for, and of all roots; all of it can be
// known for a while, and other owners can take over.
void light_is_kept_by_owners() {
  const Scene scene = builtin_scene("cornell");
  std::vector<uint8_t> right(ranks, 0);
  on_ranks(ranks, [&](Comm& comm) {
    Part part(scene, comm, 2);
    State& state = part.state;
    ThreadTeam& team = part.team;
    Exchange& exchange = part.exchange;
    const size_t bands = static_cast<size_t>(state.bands);
    const NodeId roots = static_cast<NodeId>(state.forest.surface_count());
    const NodeId nodes = static_cast<NodeId>(state.forest.nodes.size());
    const auto value = [&](NodeId id, size_t band) {
      return static_cast<float>(10 * id) + static_cast<float>(band);
    };
    size_t own = 0;
    for (NodeId k = 0; k < nodes; ++k) {
      if (!exchange.mine(state.forest, k)) continue;
      own += k >= roots;
      for (size_t b = 0; b < bands; ++b) {
        state.radiosity_of(k)[b] = value(k, b);
        state.irradiance_of(k)[b] = -value(k, b);
      }
    }
    bool all = state.places.count() == static_cast<size_t>(roots) + own &&
               state.radiosity.size() == state.places.count() * bands + State::floats_beyond;
    const auto has_all = [&](const LightOfAll& light, float sign) {
      bool same = true;
      for (NodeId k = 0; k < nodes; ++k)
        for (size_t b = 0; b < bands; ++b) same = same && light[k][b] == sign * value(k, b);
      return same;
    };
    const LightOfAll radiosity(state, &State::radiosity, exchange, team);
    const LightOfAll irradiance(state, &State::irradiance, exchange, team);
    all = all && has_all(radiosity, 1) && has_all(irradiance, -1);
    // The next rank takes over.
    std::vector<int32_t> owners = owners_of(state);
    for (int32_t& owner : owners) owner = (owner + 1) % ranks;
    exchange.deal_out(owners);
    exchange.keep_own_light(state, radiosity[0], irradiance[0]);
    for (NodeId k = 0; k < nodes; ++k)
      for (size_t b = 0; b < bands && exchange.mine(state.forest, k); ++b)
        all = all && state.radiosity_of(k)[b] == value(k, b) &&
              state.irradiance_of(k)[b] == -value(k, b);
    all = all && has_all(LightOfAll(state, &State::radiosity, exchange, team), 1);
    right[static_cast<size_t>(comm.rank())] = all;
  });
  for (uint8_t r : right) CHECK(r);
}

// Those that clusters are made of are told to all without being asked for; others are asked for.
void roots_of_clusters_are_shared() {
  const Scene scene = builtin_scene("cornell");
  constexpr NodeId in_clusters = 6;
  std::vector<uint8_t> right(ranks, 0);
  std::vector<int64_t> asked(ranks, 0);
  on_ranks(ranks, [&](Comm& comm) {
    State state(scene);
    ThreadTeam team(2);
    std::vector<ClusterItem> items;
    for (NodeId k = 0; k < in_clusters; ++k)
      items.push_back({k, state.forest.root_triangle(k).centroid(), 0.1});
    add_clusters(state.forest, items);
    const auto surfaces = static_cast<NodeId>(state.forest.surface_count());
    Exchange exchange(comm, owners_of(state));
    exchange.make_room_for_light(state);
    const size_t bands = static_cast<size_t>(state.bands);
    for (NodeId k = 0; k < surfaces; ++k)
      if (exchange.mine(k)) state.radiosity[static_cast<size_t>(k) * bands] = 1;
    exchange.share_roots_of_clusters(state, team);
    const int rank = comm.rank();
    bool all = true;
    for (NodeId k = 0; k < surfaces; ++k)
      all = all && state.radiosity[static_cast<size_t>(k) * bands] ==
                       (k < in_clusters || exchange.mine(k) ? 1.0f : 0.0f);
    const NodeId next = (rank + 1) % ranks;
    link_to(state, rank, {next, in_clusters + next, surfaces});  // the last is a cluster
    exchange.ask_for_sources(state, team);
    all = all && !exchange.comes_by_message(next) && exchange.comes_by_message(in_clusters + next);
    right[static_cast<size_t>(rank)] = all;
    asked[static_cast<size_t>(rank)] = exchange.counts().bytes[0];
  });
  for (uint8_t r : right) CHECK(r);
  for (int64_t bytes : asked) CHECK_EQUAL(bytes, static_cast<int64_t>(sizeof(NodeId)));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(elements_are_asked_for_once),
                              HRAD_TEST(what_needs_no_message_does_not_wait),
                              HRAD_TEST(totals_are_exact),
                              HRAD_TEST(roots_are_shared),
                              HRAD_TEST(light_is_kept_by_owners),
                              HRAD_TEST(roots_of_clusters_are_shared)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
