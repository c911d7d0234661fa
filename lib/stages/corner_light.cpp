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

namespace hrad {
namespace {

constexpr int64_t corners_of_a_task = 64;
// Sampled together, a second's work: what a stop in their midst loses.
constexpr size_t corners_of_a_step = 16384;
// Corners are moved into their patch by this share of the way to its middle, so that none lies in
// the plane of a wall, and by so many ray offsets at the most.
constexpr double inwards = 1e-3;
constexpr double most_offsets = 50;
constexpr int tries_for_an_exposed_point = 64;
constexpr int steps_to_a_border = 8;
constexpr double sealed = -1;

void lattice_points(const Node& node, PointsOf which, LatticePoint point[3]) {
  if (which == PointsOf::half_way_to_the_middle) return half_way_points(node, point);
  LatticePoint corner[3];
  lattice_corners(node, corner);
  for (int c = 0; c < 3; ++c)
    point[c] = which == PointsOf::corners ? corner[c] : middle(corner[c], corner[(c + 1) % 3]);
}

// Three points that have the mean of every quadratic field over a trapezoid whose parallel sides
// run from a to b and from a_far to b_far: its centroid and second moments are theirs.
void points_of_trapezoid(Vec3 a, Vec3 b, Vec3 a_far, Vec3 b_far, Vec3 place[3]) {
  const Vec3 near = (a + b) * 0.5, far = (a_far + b_far) * 0.5, height = far - near;
  const double near_half = length(b - a) / 2, far_half = length(b_far - a_far) / 2;
  const double sum = near_half + far_half;
  if (!(sum > 0)) {
    place[0] = place[1] = place[2] = near;
    return;
  }
  const Vec3 middle = near + height * ((near_half + 2 * far_half) / (3 * sum));
  const Vec3 along = near_half > 0 ? (b - a) * (1 / (2 * near_half)) : Vec3{0, 0, 0};
  const double across = std::sqrt(1 + 2 * near_half * far_half / (sum * sum)) / 6;
  const double beside = std::sqrt(near_half * near_half + far_half * far_half) / 2;
  place[0] = middle - height * across - along * beside;
  place[1] = middle - height * across + along * beside;
  place[2] = middle + height * (2 * across);
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
  std::vector<uint64_t> keys(3 * all.size());
  for_each_thing(tools_.team, all.size(), [&](size_t k) {
    const Node& node = state_.forest.nodes[all[k].element];
    LatticePoint point[3];
    lattice_points(node, all[k].which, point);
    for (size_t c = 0; c < 3; ++c) keys[3 * k + c] = key_of_corner(node.surface, point[c]);
  });
  const std::vector<uint32_t> added = number_.add(keys, static_cast<int32_t>(asked()), tools_.team);
  const size_t before = wanted_.size();
  wanted_.resize(before + added.size());
  for_each_thing(tools_.team, added.size(),
                 [&](size_t k) { wanted_[before + k] = wanted_of(keys[added[k]]); });
}

CornerSampler::Wanted CornerSampler::wanted_of(uint64_t key) const {
  const int32_t surface = surface_of_corner(key);
  const LatticePoint point = point_of_corner(key);
  const Surface& s = state_.forest.surfaces[surface];
  return {surface, mix(key_of_corner(s.patch * 2 + s.side, point), seed_),
          moved_inwards(surface, point_of(surface, point))};
}

CornerSampler::Wanted CornerSampler::own_of(NodeId element, int which, Vec3 place) const {
  const Node& node = state_.forest.nodes[element];
  return {node.surface, mix(key_of(state_.forest, node), seed_, static_cast<uint64_t>(which)),
          place};
}

int32_t CornerSampler::add(NodeId element, int which, Vec3 place) {
  wanted_.push_back(own_of(element, which, place));
  return static_cast<int32_t>(asked()) - 1;
}

void CornerSampler::add_middles(const std::vector<NodeId>& elements, int which) {
  const size_t before = wanted_.size();
  wanted_.resize(before + elements.size());
  for_each_thing(tools_.team, elements.size(), [&](size_t k) {
    const Triangle t = state_.forest.triangle(state_.forest.nodes[elements[k]]);
    wanted_[before + k] = own_of(elements[k], which, t.centroid());
  });
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
  return tools_.exposure.can_be_sealed(s.patch, s.side) &&
         tools_.exposure.sealed(s.patch, s.side, place);
}

void CornerSampler::count_memory() {
  const size_t bytes = static_cast<size_t>(number_.bytes()) + wanted_.capacity() * sizeof(Wanted) +
                       value_.capacity() * sizeof value_[0] + place_.capacity() * sizeof(Place) +
                       links_.capacity() * sizeof links_[0] + link_count_ * sizeof(Link);
  memory_.take(static_cast<int64_t>(bytes) - counted_, "points at which direct light is known");
  counted_ = static_cast<int64_t>(bytes);
}

bool CornerSampler::sample() {
  count_memory();
  const size_t count = wanted_.size();
  state_.rays += open_cubes(
      grid_, count,
      [&](size_t k) {
        return KeyedPoint{wanted_[k].surface, wanted_[k].key, point_of(wanted_[k])};
      },
      tools_);
  bool going_on = true;
  for (size_t first = 0; first < count && going_on; first += corners_of_a_step)
    going_on = sample_some(first, std::min(count, first + corners_of_a_step));
  if (!tools_.exchange.all_go_on(going_on)) return false;
  const size_t before = place_.size();
  place_.resize(before + wanted_.size());
  for_each_thing(tools_.team, wanted_.size(), [&](size_t k) {
    const Wanted& wanted = wanted_[k];
    place_[before + k] = {static_cast<float>(wanted.place.x), static_cast<float>(wanted.place.y),
                          static_cast<float>(wanted.place.z), wanted.surface};
  });
  wanted_.clear();
  count_memory();
  return true;
}

// Those from first to end-1, unless they were sampled before.
bool CornerSampler::sample_some(size_t first, size_t end) {
  const auto is_emitter = [&](NodeId source) { return grid_.emitters().is_emitter(source); };
  if (const LinkStep* done = state_.journal.done(end - first, true, is_emitter)) {
    put(*done);
    return true;
  }
  const int64_t count = static_cast<int64_t>(end - first);
  const int64_t tasks = (count + corners_of_a_task - 1) / corners_of_a_task;
  std::vector<LinkStep> results(static_cast<size_t>(tasks));
  const bool going_on = tools_.team.for_each(
      tasks,
      [&](int64_t task, int) {
        LinkStep& r = results[task];
        const int64_t last = std::min(count, (task + 1) * corners_of_a_task);
        for (int64_t at = task * corners_of_a_task; at < last; ++at) {
          const size_t k = first + static_cast<size_t>(at);
          const Wanted& wanted = wanted_[k];
          const size_t before = r.links.size();
          double value = sealed;
          if (!is_sealed(wanted.surface, wanted.place)) {
            r.rays += light_.sample(point_of(wanted), wanted.key, r.links);
            value = 0;
            for (size_t l = before; l < r.links.size(); ++l)
              value +=
                  static_cast<double>(r.links[l].weight) * brightness_.of_node[r.links[l].source];
          }
          r.values.push_back(static_cast<float>(value));
          r.counts.push_back(static_cast<uint32_t>(r.links.size() - before));
        }
        r.links.shrink_to_fit();
      },
      [&](int64_t done) {
        const double known = static_cast<double>(value_.size()) +
                             static_cast<double>(done * count) / static_cast<double>(tasks);
        return tools_.progress(known / static_cast<double>(std::max(expected_, asked())));
      });
  if (!going_on) return false;
  if (state_.journal.recording) {
    LinkStep step;
    for (const LinkStep& r : results) step.append(r);
    state_.journal.record(std::move(step));
  }
  for (LinkStep& r : results) put(std::move(r));
  return true;
}

void CornerSampler::put(LinkStep step) {
  const Link* next = step.links.data();
  for (uint32_t count : step.counts) {
    links_.push_back({next, count});
    next += count;
  }
  value_.insert(value_.end(), step.values.begin(), step.values.end());
  state_.rays += step.rays;
  link_count_ += step.links.size();
  if (link_count_ > 0xffffffffu)
    fail(Status::memory,
         "more than 4,294,967,295 links from bright emitters: use a larger accuracy");
  parts_.push_back(std::move(step.links));
}

OrientedPoint CornerSampler::point_of(const Wanted& wanted) const {
  return {wanted.place, state_.forest.surfaces[wanted.surface].normal};
}

// The last exposed point on the way.
Vec3 CornerSampler::border(int32_t surface, Vec3 exposed, Vec3 sealed) const {
  for (int k = 0; k < steps_to_a_border; ++k) {
    const Vec3 between = (exposed + sealed) * 0.5;
    (is_sealed(surface, between) ? sealed : exposed) = between;
  }
  return exposed;
}

bool CornerSampler::points_of_exposed(NodeId id, const LatticePoint corner[3],
                                      Vec3 place[3]) const {
  const Node& node = state_.forest.nodes[id];
  const int32_t surface = node.surface;
  Vec3 open[3], shut[3];
  int exposed = 0, sealed = 0;
  for (int c = 0; c < 3; ++c) {
    const Vec3 on = point_of(surface, corner[c]), within = moved_inwards(surface, on);
    if (is_sealed(surface, within))
      shut[sealed++] = on;
    else
      open[exposed++] = within;
  }
  if (exposed == 1 || exposed == 3) {
    const Vec3 triangle[3] = {open[0], exposed == 3 ? open[1] : border(surface, open[0], shut[0]),
                              exposed == 3 ? open[2] : border(surface, open[0], shut[1])};
    const Vec3 middle = (triangle[0] + triangle[1] + triangle[2]) * (1.0 / 3);
    for (int c = 0; c < 3; ++c) place[c] = (triangle[c] + middle) * 0.5;
  } else if (exposed == 2) {
    points_of_trapezoid(open[0], open[1], border(surface, open[0], shut[0]),
                        border(surface, open[1], shut[0]), place);
  }
  Vec3 somewhere;
  bool found = false;
  for (int c = 0; c < 3; ++c) {
    if (exposed > 0 && !is_sealed(surface, place[c])) continue;
    if (!found && !exposed_within(node, &somewhere)) return false;
    found = true;
    place[c] = somewhere;
  }
  return true;
}

bool CornerSampler::exposed_within(const Node& node, Vec3* place) const {
  const Triangle corners = state_.forest.triangle(node);
  const uint64_t key = mix(key_of(state_.forest, node), seed_, 0x77697468u);
  for (int k = 0; k < tries_for_an_exposed_point; ++k) {
    double uv[2];
    spread_point(mix(key, static_cast<uint64_t>(k / 16)), k % 16, uv);
    *place = corners.at(uv[0], uv[1]);
    if (!is_sealed(node.surface, *place)) return true;
  }
  return false;
}

void CornerSampler::keep_what_is_named() {
  const Emitters& emitters = grid_.emitters();
  number_points_by_leaves(
      state_.direct, value_.size(), [](NodeId) { return true; },
      [&](int32_t point, std::vector<Link>& kept) {
        const Place& p = place_[static_cast<size_t>(point)];
        const Vec3 normal = state_.forest.surfaces[p.surface].normal;
        for (const Link& link : links_of(point))
          if (emitters.bright(emitters.all()[emitters.of_node(link.source)], {p.x, p.y, p.z},
                              normal))
            kept.push_back(link);
      },
      &tools_.team);
}

}  // namespace hrad
