// Sampling corners. Floor 7 (stages).
#include "stages/corner_light.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "links/element.h"
#include "links/pair_samples.h"
#include "machine/pieces.h"
#include "stages/exchange.h"
#include "stages/open_cubes.h"
#include "stages/point_numbers.h"
#include "stages/task_names.h"

namespace hrad {
namespace {

constexpr size_t corners_of_a_task = 16;
// Sampled together, about a second's work.
constexpr size_t corners_of_a_step = 16384;
// Corners are moved into their patch by this share of the way to its middle, so that none lies in
// the plane of a wall, and by so many ray offsets at the most.
constexpr double inwards = 1e-3;
constexpr double most_offsets = 50;
constexpr double sealed = -1;

void lattice_points(const Node& node, PointsOf which, LatticePoint point[3]) {
  if (which == PointsOf::half_way_to_the_middle) return half_way_points(node, point);
  LatticePoint corner[3];
  lattice_corners(node, corner);
  for (int c = 0; c < 3; ++c)
    point[c] = which == PointsOf::corners ? corner[c] : middle(corner[c], corner[(c + 1) % 3]);
}

}  // namespace

CornerSampler::CornerSampler(State& state, const StageTools& tools, const DirectLight& light,
                             LightGrid& grid, const Brightness& brightness, uint64_t seed)
    : state_(state),
      tools_(tools),
      brightness_(brightness),
      grid_(grid),
      light_(light),
      seed_(seed),
      memory_(state) {
  state_.direct = CornerLight{};
  state_.direct.first.push_back(0);
}

void CornerSampler::want(const std::vector<ElementPoints>& all) {
  GrowingArray<uint64_t> keys;  // as all that is large here, first written to by the team
  keys.resize_for_overwrite(3 * all.size());
  for_each_thing(tools_.team, all.size(), [&](size_t k) {
    const Node& node = state_.forest.nodes[all[k].element];
    LatticePoint point[3];
    lattice_points(node, all[k].which, point);
    for (size_t c = 0; c < 3; ++c) keys[3 * k + c] = key_of_corner(node.surface, point[c]);
  });
  const std::vector<uint32_t> added =
      number_.add({keys.data(), keys.size()}, static_cast<int32_t>(asked()), tools_.team);
  const size_t before = wanted_.size();
  wanted_.resize_for_overwrite(before + added.size());
  for_each_thing(tools_.team, added.size(),
                 [&](size_t k) { wanted_[before + k] = wanted_of(keys[added[k]]); });
}

CornerSampler::Wanted CornerSampler::wanted_of(uint64_t key) const {
  const int32_t surface = surface_of_corner(key);
  const LatticePoint point = point_of_corner(key);
  const Surface& s = state_.forest.surfaces[surface];
  return {surface, mix(key_of_corner(s.patch * 2 + s.side, point), seed_),
          name_of_corner(surface, point), moved_inwards(surface, point_of(surface, point))};
}

CornerSampler::Wanted CornerSampler::own_of(const PointOfElement& point) const {
  const Node& node = state_.forest.nodes[point.element];
  return {node.surface, mix(key_of(state_.forest, node), seed_, static_cast<uint64_t>(point.which)),
          name_of_element(state_.forest, point.element, point.which), point.place};
}

void CornerSampler::add(const std::vector<PointOfElement>& points) {
  const size_t before = wanted_.size();
  wanted_.resize_for_overwrite(before + points.size());
  for_each_thing(tools_.team, points.size(),
                 [&](size_t k) { wanted_[before + k] = own_of(points[k]); });
}

Vec3 CornerSampler::point_of(int32_t surface, LatticePoint point) const {
  return state_.forest.root_triangle(surface).at(static_cast<double>(point.i) / lattice_size,
                                                 static_cast<double>(point.j) / lattice_size);
}

Vec3 CornerSampler::moved_inwards(int32_t surface, Vec3 on) const {
  const Vec3 way = state_.forest.root_triangle(surface).centroid() - on;
  const double distance = length(way);
  if (!(distance > 0)) return on;
  return on + way * std::min(inwards, most_offsets * tools_.engine.offset() / distance);
}

bool CornerSampler::is_sealed(int32_t surface, Vec3 place) const {
  const Surface& s = state_.forest.surfaces[surface];
  return tools_.exposure.sealed(s.patch, s.side, place);
}

void CornerSampler::count_memory() {
  const size_t bytes = static_cast<size_t>(number_.bytes()) + wanted_.capacity() * sizeof(Wanted) +
                       value_.capacity() * sizeof value_[0] + place_.capacity() * sizeof(Place) +
                       links_.capacity() * sizeof links_[0] + link_count_ * sizeof(Link);
  memory_.take(static_cast<int64_t>(bytes) - counted_, "points at which direct light is known");
  counted_ = static_cast<int64_t>(bytes);
}

bool CornerSampler::sample(double work) {
  count_memory();
  const size_t count = wanted_.size();
  const auto point = [&](size_t k) {
    return KeyedPoint{wanted_[k].surface, wanted_[k].key, point_of(wanted_[k])};
  };
  if (!open_cubes(grid_, count, point, state_, tools_)) return false;
  state_.journal.next_pass();
  const size_t before = value_.size();
  value_.resize_for_overwrite(before + count);
  links_.resize_for_overwrite(before + count);
  place_.resize_for_overwrite(before + count);
  for_each_thing(tools_.team, count, [&](size_t k) {
    const Wanted& wanted = wanted_[k];
    value_[before + k] = 0;
    links_[before + k] = {};
    place_[before + k] = {static_cast<float>(wanted.place.x), static_cast<float>(wanted.place.y),
                          static_cast<float>(wanted.place.z), wanted.surface};
  });
  bool going_on = true;
  for (size_t first = 0; first < count && going_on; first += corners_of_a_step)
    going_on =
        sample_some(before + first, before + std::min(count, first + corners_of_a_step), work);
  if (!tools_.exchange.all_go_on(going_on)) return false;
  work_ += work * static_cast<double>(count);
  wanted_ = GrowingArray<Wanted>();
  count_memory();
  return true;
}

// The points from first to end-1.
bool CornerSampler::sample_some(size_t first, size_t end, double work) {
  const auto is_emitter = [&](NodeId source) { return grid_.emitters().is_emitter(source); };
  const size_t first_wanted = value_.size() - wanted_.size(), first_part = parts_.size();
  const size_t tasks = pieces_of(end - first, corners_of_a_task);
  parts_.resize(first_part + tasks);
  std::vector<int64_t> rays(end - first, 0);
  std::vector<uint8_t> is_new(end - first, 0);  // what is sealed, or known, is not
  const auto sample = [&](size_t k, std::vector<Link>& links) {
    const Wanted& wanted = wanted_[k - first_wanted];
    if (is_sealed(wanted.surface, wanted.place)) return sealed;
    const size_t before = links.size();
    is_new[k - first] = !state_.journal.known_run(wanted.name, is_emitter, links, rays[k - first]);
    if (is_new[k - first]) rays[k - first] = light_.sample(point_of(wanted), wanted.key, links);
    return light_.light_of(point_of(wanted), {links.data() + before, links.size() - before},
                           brightness_.of_node);
  };
  const auto first_of = [&](int64_t task) {
    return std::min(end, first + static_cast<size_t>(task) * corners_of_a_task);
  };
  const bool going_on = state_.journal.for_each(
      tools_.team, static_cast<int64_t>(tasks),
      [&](int64_t task, int) {
        Part& part = parts_[first_part + static_cast<size_t>(task)];
        std::vector<Link>& links = part.links;
        size_t count_of[corners_of_a_task] = {};
        const size_t from = first_of(task), to = first_of(task + 1);
        part.first = from;
        for (size_t k = from; k < to; ++k) {
          const size_t before = links.size();
          value_[k] = static_cast<float>(sample(k, links));
          count_of[k - from] = links.size() - before;
        }
        links.shrink_to_fit();
        Link* next = links.data();
        for (size_t k = from; k < to; next += count_of[k++ - from])
          links_[k] = {next, count_of[k - from]};
      },
      [&](int64_t done) {
        const double points = static_cast<double>(first - first_wanted) +
                              static_cast<double>(done) * static_cast<double>(end - first) /
                                  static_cast<double>(tasks);
        const double asked = work_ + work * static_cast<double>(wanted_.size());
        return tools_.progress((work_ + work * points) / std::max(expected_, asked));
      },
      [&](LinkStep& step, int64_t task) {
        for (size_t k = first_of(task); k < first_of(task + 1); ++k)
          if (is_new[k - first])
            step.add_run(wanted_[k - first_wanted].name, links_[k], rays[k - first]);
      });
  if (!going_on) return false;
  for (int64_t r : rays) state_.rays += r;
  sampled_ = end;
  for (size_t part = first_part; part < parts_.size(); ++part)
    count_links(parts_[part].links.size());
  return true;
}

void CornerSampler::forget_links(size_t first) {
  // A part that holds links of points before stays.
  for (; !parts_.empty() && parts_.back().first >= first; parts_.pop_back())
    link_count_ -= parts_.back().links.size();
  std::fill(links_.begin() + first, links_.end(), Span<Link>());
  count_memory();
}

void CornerSampler::count_links(size_t more) {
  link_count_ += more;
  if (link_count_ > 0xffffffffu)
    fail(Status::memory,
         "more than 4,294,967,295 links from bright emitters: use a larger accuracy");
}

OrientedPoint CornerSampler::point_of(const Wanted& wanted) const {
  return {wanted.place, state_.forest.surfaces[wanted.surface].normal};
}

void CornerSampler::keep_what_is_named() {
  number_ = KeyNumbers();
  wanted_ = GrowingArray<Wanted>();
  state_.direct.of_leaf.settle(tools_.team);
  const Emitters& emitters = grid_.emitters();
  number_points_by_leaves(
      state_.direct, value_.size(),
      [&](int32_t point) -> Span<const Link> {
        const Place& p = place_[static_cast<size_t>(point)];
        const Vec3 normal = state_.forest.surfaces[p.surface].normal;
        const auto is_not_bright = [&](const Link& link) {
          return !emitters.bright(emitters.all()[emitters.of_node(link.source)], {p.x, p.y, p.z},
                                  normal);
        };
        const Span<Link> links = links_[static_cast<size_t>(point)];
        return {links.begin(),
                static_cast<size_t>(std::remove_if(links.begin(), links.end(), is_not_bright) -
                                    links.begin())};
      },
      tools_.team);
}

}  // namespace hrad
