// Numbers of points: neighbours share the points of their corners, and new ones are numbered in the
// order of the leaves, so that most numbers are known beforehand. Floor 8 (solver).
#include <array>
#include <cstdint>
#include <unordered_map>

#include "hierarchy/lattice.h"
#include "solver/checkpoint_light.h"

namespace hrad {
namespace {

// Foretells the numbers of a run of nodes.
class PointGuess {
 public:
  // Of corner c of a leaf: the number that this place has already, -1: none.
  int32_t known(const Node& node, int c) {
    if (node.light_points == at_own_points) return -1;
    LatticePoint point[3];
    if (node.light_points == half_way_to_the_middle)
      half_way_points(node, point);
    else
      lattice_corners(node, point);
    // 2^15 + 1 places along each edge.
    key_ = static_cast<uint64_t>(static_cast<uint32_t>(node.surface)) << 32 |
           static_cast<uint32_t>(point[c].i) << 16 | static_cast<uint32_t>(point[c].j);
    const auto found = number_.find(key_);
    return found == number_.end() ? -1 : found->second;
  }
  // Where a new number is expected: behind the last new one.
  int64_t next() const { return next_; }
  // The number of the place that was asked about last.
  void tell(const Node& node, int32_t number, bool is_new) {
    if (is_new) next_ = static_cast<int64_t>(number) + 1;
    if (node.light_points != at_own_points) number_[key_] = number;
  }

 private:
  uint64_t key_ = 0;
  std::unordered_map<uint64_t, int32_t> number_;  // looked up only
  int64_t next_ = 0;
};

bool can_have_points(const Node& node) { return !Forest::is_cluster(node) && node.first_child < 0; }

constexpr double largest_place = 16;  // of a point in its leaf: within, but for rounding

}  // namespace

void pack_points(const Forest& forest, int64_t first, int64_t end, const PointsOf& points_of,
                 PackedBytes& bytes) {
  PointGuess guess;
  for (int64_t id = first; id < end; ++id) {
    const Node& node = forest.nodes[static_cast<size_t>(id)];
    if (!can_have_points(node)) continue;
    const LeafPoints::Numbers points = points_of(id);
    bytes.byte(points[0] >= 0);
    for (int c = 0; c < 3 && points[0] >= 0; ++c) {
      const int32_t known = guess.known(node, c);
      const bool as_known = known >= 0 && known == points[c];
      if (as_known)
        bytes.varint(0);
      else
        bytes.varint((known >= 0 ? 1u : 0u) + zigzag(points[c] - guess.next()));
      guess.tell(node, points[c], !as_known);
    }
  }
}

void unpack_points(PackedReader& bytes, int64_t first, int64_t end, State& state) {
  const auto most = static_cast<int64_t>(state.direct.point_count()) - 1;
  PointGuess guess;
  for (int64_t id = first; id < end; ++id) {
    const Node& node = state.forest.nodes[static_cast<size_t>(id)];
    LeafPoints::Numbers points = LeafPoints::none;
    if (can_have_points(node) && bytes.flag("whether a leaf has points"))
      for (int c = 0; c < 3; ++c) {
        const int32_t known = guess.known(node, c);
        const uint64_t code = bytes.varint();
        const bool as_known = known >= 0 && code == 0;
        const int64_t number =
            as_known ? known : moved(guess.next(), from_zigzag(code - (known >= 0 ? 1u : 0u)));
        if (number < 0 || number > most)
          fail_format(bytes.place(), "a point of leaf %lld is %lld: it must be from 0 to %lld",
                      static_cast<long long>(id), static_cast<long long>(number),
                      static_cast<long long>(most));
        points[static_cast<size_t>(c)] = static_cast<int32_t>(number);
        guess.tell(node, static_cast<int32_t>(number), !as_known);
      }
    if (points[0] < 0 || node.light_points != at_own_points) {
      state.direct.of_leaf.append(points);
      continue;
    }
    if (points[1] != points[0] + 1 || points[2] != points[0] + 2)
      fail_format(bytes.place(), "the points that are leaf %lld's own are %d, %d and %d",
                  static_cast<long long>(id), points[0], points[1], points[2]);
    state.direct.of_leaf.append_own(points[0], {});
  }
}

void pack_own_points(int64_t first, int64_t end, const OwnPointAt& point_at, PackedBytes& bytes) {
  int64_t before = -1;
  std::vector<uint32_t> places;
  for (int64_t k = first; k < end; ++k) {
    const OwnPoint point = point_at(k);
    bytes.signed_varint(point.number - before - 1);
    before = point.number;
    places.push_back(bits_of(point.place.x));
    places.push_back(bits_of(point.place.y));
  }
  bytes.planes(places);
}

void unpack_own_points(PackedReader& bytes, int64_t first, int64_t end, CornerLight& direct) {
  const auto most = static_cast<int64_t>(direct.point_count()) - 1;
  LeafPoints& of_leaf = direct.of_leaf;
  int64_t number = -1;
  for (int64_t k = first; k < end; ++k) {
    number = bytes.moved(number + 1, "a leaf's own point", 0, most);
    const size_t leaf = static_cast<size_t>(k / 3);
    if (leaf >= of_leaf.own_count() || number != of_leaf.first_own(leaf) + k % 3)
      fail_format(bytes.place(), "own point %lld is %lld, which no leaf names in this place",
                  static_cast<long long>(k), static_cast<long long>(number));
  }
  std::vector<uint32_t> places;
  bytes.planes(2 * static_cast<size_t>(end - first), places);
  for (size_t k = 0; k < places.size(); ++k) {
    const float place = float_of(places[k]);
    if (!(place >= -largest_place && place <= largest_place))
      fail_format(bytes.place(), "an own point lies at %g in its leaf", static_cast<double>(place));
    const size_t point = static_cast<size_t>(first) + k / 2;
    LeafPoints::Place& to = of_leaf.own(point / 3)[point % 3];
    (k % 2 ? to.y : to.x) = place;
  }
}

void check_points(const State& state, const FilePlace& place) {
  const LeafPoints& of_leaf = state.direct.of_leaf;
  std::vector<int32_t> surface(state.direct.point_count(), -1);
  std::vector<uint8_t> is_own(state.direct.point_count(), 0), is_named = is_own;
  for (size_t k = 0; k < of_leaf.own_count(); ++k)
    for (int32_t c = 0; c < 3; ++c) is_own[static_cast<size_t>(of_leaf.first_own(k) + c)] = 1;
  for (size_t id = 0; id < of_leaf.size(); ++id) {
    const LeafPoints::Numbers points = of_leaf[id];
    if (points[0] < 0) continue;
    const Node& node = state.forest.nodes[id];
    for (const int32_t number : points) {
      const size_t point = static_cast<size_t>(number);
      if (surface[point] >= 0 && surface[point] != node.surface)
        fail_format(place, "point %d belongs to the surfaces %d and %d", number, surface[point],
                    node.surface);
      surface[point] = node.surface;
      if (is_own[point] && is_named[point]++ > 0)
        fail_format(place, "point %d is the own one of two leaves", number);
    }
  }
}

}  // namespace hrad
