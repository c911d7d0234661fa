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
    const std::array<int32_t, 3> points = points_of(id);
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
    std::array<int32_t, 3> points{-1, -1, -1};
    if (can_have_points(node) && bytes.flag("whether a leaf has points"))
      for (int c = 0; c < 3; ++c) {
        const int32_t known = guess.known(node, c);
        const uint64_t code = bytes.varint();
        const bool as_known = known >= 0 && code == 0;
        const int64_t number =
            as_known ? known : guess.next() + from_zigzag(code - (known >= 0 ? 1u : 0u));
        if (number < 0 || number > most)
          fail_format(bytes.place(), "a point of leaf %lld is %lld: it must be from 0 to %lld",
                      static_cast<long long>(id), static_cast<long long>(number),
                      static_cast<long long>(most));
        points[static_cast<size_t>(c)] = static_cast<int32_t>(number);
        guess.tell(node, static_cast<int32_t>(number), !as_known);
      }
    state.direct.of_leaf.push_back(points);
  }
}

void pack_own_points(int64_t first, int64_t end, const OwnPointAt& point_at, PackedBytes& bytes) {
  int64_t before = -1;
  std::vector<uint32_t> places;
  for (int64_t k = first; k < end; ++k) {
    const CornerLight::OwnPoint point = point_at(k);
    bytes.signed_varint(point.number - before - 1);
    before = point.number;
    places.push_back(bits_of(point.x));
    places.push_back(bits_of(point.y));
  }
  bytes.planes(places);
}

void unpack_own_points(PackedReader& bytes, int64_t first, int64_t end, CornerLight& direct) {
  const auto most = static_cast<int64_t>(direct.point_count()) - 1;
  const size_t begin = direct.own.size();
  int64_t number = -1;
  for (int64_t k = first; k < end; ++k) {
    number = bytes.moved(number + 1, "a leaf's own point", 0, most);
    if (!direct.own.empty() && number <= direct.own.back().number)
      fail_format(bytes.place(), "own point %lld follows %d: they must ascend",
                  static_cast<long long>(number), direct.own.back().number);
    direct.own.push_back({static_cast<int32_t>(number), 0, 0});
  }
  std::vector<uint32_t> places;
  bytes.planes(2 * static_cast<size_t>(end - first), places);
  for (size_t k = 0; k < places.size(); ++k) {
    const float place = float_of(places[k]);
    if (!(place >= -largest_place && place <= largest_place))
      fail_format(bytes.place(), "an own point lies at %g in its leaf", static_cast<double>(place));
    (k % 2 ? direct.own[begin + k / 2].y : direct.own[begin + k / 2].x) = place;
  }
}

void check_points(const State& state, const FilePlace& place) {
  const CornerLight& direct = state.direct;
  std::vector<int32_t> surface(direct.point_count(), -1);
  std::vector<uint8_t> is_named(direct.point_count(), 0);
  size_t own = 0;
  std::vector<int32_t> number_of_own(direct.point_count(), -1);
  for (const auto& point : direct.own)
    number_of_own[static_cast<size_t>(point.number)] = static_cast<int32_t>(own++);
  for (size_t id = 0; id < direct.of_leaf.size(); ++id) {
    const auto& points = direct.of_leaf[id];
    if (points[0] < 0) continue;
    const Node& node = state.forest.nodes[id];
    for (size_t c = 0; c < 3; ++c) {
      int32_t& of_point = surface[static_cast<size_t>(points[c])];
      if (of_point >= 0 && of_point != node.surface)
        fail_format(place, "point %d belongs to the surfaces %d and %d", points[c], of_point,
                    node.surface);
      of_point = node.surface;
      const int32_t first = number_of_own[static_cast<size_t>(points[0])];
      if (node.light_points == at_own_points &&
          (first < 0 ||
           number_of_own[static_cast<size_t>(points[c])] != first + static_cast<int32_t>(c)))
        fail_format(place, "leaf %zu has points of its own that have no place", id);
      if (number_of_own[static_cast<size_t>(points[c])] >= 0 &&
          is_named[static_cast<size_t>(points[c])]++ > 0)
        fail_format(place, "point %d is the own one of two leaves", points[c]);
    }
  }
}

}  // namespace hrad
