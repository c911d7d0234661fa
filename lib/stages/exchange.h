// What the owners of surfaces tell each other (paper, Section 3.1): the results of tasks, each done
// by one of them, and radiosity. Elements are known to all; links only to the owner of their
// receiver, and light to that of its element and to whoever has asked for it. With one owner of
// everything nothing is exchanged. Floor 7 (stages).
#pragma once

#include <utility>
#include <vector>

#include "base/exact_sum.h"
#include "machine/shared_rows.h"
#include "machine/sharing.h"
#include "stages/state.h"

namespace hrad {

// By kind: ids of elements whose radiosity is asked for (R), radiosity (U), the radiosity
// transported and, where all need it, the light on roots (T).
struct MessageCounts {
  int64_t messages[3] = {0, 0, 0}, bytes[3] = {0, 0, 0};
};

class Exchange {
 public:
  // owner_of_surface: a rank for each; comm must outlive this.
  Exchange(Comm& comm, std::vector<int32_t> owner_of_surface);

  bool alone() const { return comm_.alone(); }
  int32_t owner(int32_t surface) const { return owner_[surface]; }
  const std::vector<int32_t>& owners() const { return owner_; }
  int32_t owner_count() const { return comm_.size(); }
  bool is_me(int32_t owner) const { return owner == comm_.rank(); }
  bool mine(int32_t surface) const { return is_me(owner_[surface]); }
  bool mine(const Forest& forest, NodeId id) const { return mine(surface_of(forest, id)); }
  const std::vector<int32_t>& own_surfaces() const { return own_; }  // ascending
  // A cluster belongs to the owner of its first surface.
  static int32_t surface_of(const Forest& forest, NodeId id) {
    const Node& node = forest.nodes[id];
    return Forest::is_cluster(node) ? forest.clusters.order[forest.cluster(node).first]
                                    : node.surface;
  }
  // Of tasks that belong to no surface each takes its turn.
  bool my_turn(int64_t task) const { return is_my_turn(comm_, static_cast<size_t>(task)); }

  // Collective, as all that follows: whether every one of them goes on.
  bool all_go_on(bool mine) const { return comm_.all_go_on(mine); }

  // values[k] belongs to surface_of(k): each owner gives its own, and has all of them afterwards.
  template <class T, class SurfaceOf>
  void share(std::vector<T>& values, const SurfaceOf& surface_of) const {
    share_rows(values, 1, surface_of);
  }
  // The same of rows of so many values.
  template <class T, class SurfaceOf>
  void share_rows(std::vector<T>& rows, size_t values, const SurfaceOf& surface_of) const {
    hrad::share(
        comm_, rows.size() / values, [&](size_t k) { return owner_[surface_of(k)]; },
        [&](size_t k, Bytes& bytes) { put(bytes, &rows[k * values], values); },
        [&](size_t k, Taker& taker) { taker.take(&rows[k * values], values); });
  }
  // The same two by a team, where that isn't at work: reports of progress may ask for the first
  // ones.
  template <class T, class SurfaceOf>
  void share(std::vector<T>& values, const SurfaceOf& surface_of, ThreadTeam& team) const {
    share_rows(values, 1, surface_of, team);
  }
  template <class T, class SurfaceOf>
  void share_rows(std::vector<T>& rows, size_t values, const SurfaceOf& surface_of,
                  ThreadTeam& team) const {
    share_rows_of(comm_, team, rows, values, [&](size_t k) { return owner_[surface_of(k)]; });
  }
  template <class T, class SurfaceOf>
  void share_lists(std::vector<std::vector<T>>& lists, const SurfaceOf& surface_of) const {
    hrad::share_lists(comm_, lists, [&](size_t k) { return owner_[surface_of(k)]; });
  }
  // Marks of the owners, 0 but for few.
  void share_marks(std::vector<uint8_t>& marks) const { hrad::share_marks(comm_, marks); }
  // Every process's values one after the other, in any order.
  template <class T>
  void unite(std::vector<T>& values) const {
    hrad::unite(comm_, values);
  }
  // The same, but each gets those of its own surfaces alone, surface_of(value).
  template <class T, class SurfaceOf>
  void send_to_owners(std::vector<T>& values, const SurfaceOf& surface_of) const {
    hrad::send_to_owners(comm_, values, [&](const T& value) { return owner_[surface_of(value)]; });
  }
  // values[k] where each took its turn.
  template <class T>
  void share_turns(std::vector<T>& values, ThreadTeam& team) const {
    share_rows_of(comm_, team, values, 1, [&](size_t k) {
      return static_cast<int>(k % static_cast<size_t>(comm_.size()));
    });
  }

  // Not collective: places for the light of nodes that are new, where they are own, and room.
  void make_places_for_light(State& state) const;
  void make_room_for_light(State& state) const {
    make_places_for_light(state);
    state.resize_light();
  }
  // Not collective: of the light of all nodes, one after the other, that which a process keeps.
  void keep_own_light(State& state, const float* radiosity, const float* irradiance) const;
  // Asks for the elements that own links have begun to name since the last time (R), and is told
  // how they shine at present (U).
  void ask_for_sources(State& state, ThreadTeam& team);
  bool comes_by_message(NodeId source) const {
    return static_cast<size_t>(source) < asked_.size() && asked_[static_cast<size_t>(source)];
  }
  // Tells others the radiosity of what they have asked for (U). Theirs is here after
  // finish_update(), which does nothing where there is no update under way; work between the two
  // overlaps the messages, which make_progress() is to help along now and then (not collective).
  void start_update(const State& state, ThreadTeam& team);
  void finish_update(State& state, ThreadTeam& team);
  void make_progress() const;
  // What all processes have added up.
  void add_up(std::vector<ExactSum>& sums) const;
  // The same of the radiosity transported, a sum for each band (T).
  void add_up_transported(std::vector<ExactSum>& sums);
  // Light on the roots, or on those that clusters are made of, known to all (T).
  void share_roots(State& state, ThreadTeam& team);
  void share_roots_of_clusters(State& state, ThreadTeam& team);
  // Not collective, but all do it: nothing is asked for any more, and light means nothing until it
  // is reset.
  void forget(State& state);
  // Other owners of the surfaces from now on, to be asked anew.
  void deal_out(std::vector<int32_t> owner_of_surface);

  const MessageCounts& counts() const { return counts_; }
  Comm& comm() const { return comm_; }

 private:
  void forget_requests();
  void count(int kind, const std::vector<Bytes>& sent);
  void count_totals(int64_t bytes);

  Comm& comm_;
  std::vector<int32_t> owner_, own_;
  std::vector<bool> asked_;  // per node
  // Of what is asked for, places of light, per rank; they stay as long as it is.
  std::vector<std::vector<uint32_t>> asked_of_, asked_by_;
  MessageCounts counts_;
};

}  // namespace hrad
