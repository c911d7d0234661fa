// Joining emitters, and how large they may look. Floor 6 (links).
#include "links/emitters.h"

#include <algorithm>
#include <cmath>

#include "base/angle.h"
#include "base/draw.h"
#include "base/low_discrepancy.h"
#include "base/triangle_points.h"

namespace hrad {
namespace {

constexpr size_t most_surfaces_of_an_emitter = 8;
// Fewer emitters than that are looked at one by one.
constexpr size_t worth_joining = 16;
// Widest angle between the normals in a group and their mean, rad: its light falls off by one
// cosine.
constexpr double widest_group = 0.1;

bool shine_alike(const Scene& scene, const Surface& a, const Surface& b) {
  for (int k = 0; k < scene.bands; ++k)
    if (scene.emission[static_cast<size_t>(a.patch) * scene.bands + k] !=
        scene.emission[static_cast<size_t>(b.patch) * scene.bands + k])
      return false;
  return true;
}

bool share_an_edge(const Triangle& a, const Triangle& b) {
  int common = 0;
  for (const Vec3& p : {a.a, a.b, a.c})
    for (const Vec3& q : {b.a, b.b, b.c}) common += p.x == q.x && p.y == q.y && p.z == q.z;
  return common >= 2;
}

// Places that are looked at for the middle of what is exposed, and in all to find points that are:
// nearly all may be sealed.
constexpr uint32_t places_of_a_center = 64, most_places = 4096;

void finish(const Forest& forest, const Exposure& exposure, Emitter& e) {
  Vec3 sum{0, 0, 0}, sum_even{0, 0, 0};
  std::vector<double> areas;
  for (NodeId root : e.surfaces) {
    const double area = forest.surfaces[root].area;
    sum = sum + forest.root_triangle(root).centroid() * area;
    e.area += area;
    areas.push_back(area);
    e.exposed.push_back(forest.nodes[root].exposed);
    e.exposed_area += area * e.exposed.back();
    sum_even = sum_even + forest.root_triangle(root).centroid() * (area * e.exposed.back());
  }
  e.center = sum * (1 / e.area);
  for (NodeId root : e.surfaces) {
    const Triangle t = forest.root_triangle(root);
    for (const Vec3& corner : {t.a, t.b, t.c})
      e.radius = std::max(e.radius, length(corner - e.center));
  }
  e.even_center = e.exposed_center = sum_even * (1 / e.exposed_area);
  const bool partly_sealed = e.exposed_area < e.area;
  const Surface& first = forest.surfaces[e.surfaces.front()];
  const uint64_t key = mix(static_cast<uint64_t>(first.patch), static_cast<uint64_t>(first.side));
  const Draw draw(areas);
  Vec3 sum_exposed{0, 0, 0};
  int exposed = 0;
  size_t points = 0;
  for (uint32_t k = 0; points < Emitter::point_count || (partly_sealed && k < places_of_a_center);
       ++k) {
    double p[4];
    low_discrepancy_point(key, k, p);
    // The first coordinate picks the surface and goes on within it.
    const size_t pick = draw.pick(p[0]);
    const NodeId root = e.surfaces[pick];
    double u, v;
    even_in_triangle(draw.rest(pick, p[0]), p[1], &u, &v);
    const Vec3 place = forest.root_triangle(root).at(u, v);
    const Surface& surface = forest.surfaces[root];
    if (k < most_places && exposure.sealed(surface.patch, surface.side, place)) continue;
    if (points < Emitter::point_count) {
      const Vec3 way = place - e.center;
      e.from_center[points++] = {static_cast<float>(way.x), static_cast<float>(way.y),
                                 static_cast<float>(way.z)};
    }
    if (k >= places_of_a_center) continue;
    sum_exposed = sum_exposed + place;
    ++exposed;
  }
  if (partly_sealed && exposed > 0) e.exposed_center = sum_exposed * (1.0 / exposed);
}

}  // namespace

Emitters::Emitters(const Forest& forest, const Exposure& exposure,
                   const std::vector<float>& brightness, double least_bright)
    : of_node_(static_cast<size_t>(forest.surface_count()), -1), least_bright_(least_bright) {
  const Scene& scene = *forest.scene;
  for (NodeId root = 0; root < forest.surface_count(); ++root) {
    const Surface& surface = forest.surfaces[root];
    if (!scene.emits(surface.patch) || !(forest.nodes[root].exposed > 0)) continue;
    // In an enclosure the mean radiosity equals the mean irradiance: what shines no brighter than
    // all else makes no noise.
    const double excess = brightness[root] - 1.0;
    if (!(excess > 0)) continue;
    // Faces of one polygon follow each other.
    if (!emitters_.empty()) {
      Emitter& last = emitters_.back();
      const Surface& other = forest.surfaces[last.surfaces.back()];
      if (last.surfaces.size() < most_surfaces_of_an_emitter && last.brightness == excess &&
          share_plane(surface, other) && shine_alike(scene, surface, other) &&
          share_an_edge(forest.root_triangle(root), forest.root_triangle(last.surfaces.back()))) {
        last.surfaces.push_back(root);
        of_node_[root] = static_cast<int32_t>(emitters_.size()) - 1;
        continue;
      }
    }
    of_node_[root] = static_cast<int32_t>(emitters_.size());
    emitters_.emplace_back();
    emitters_.back().normal = surface.normal;
    emitters_.back().brightness = excess;
    emitters_.back().surfaces.push_back(root);
  }
  for (Emitter& e : emitters_) finish(forest, exposure, e);
  for (size_t e = 0; e < emitters_.size(); ++e) tops_.push_back(static_cast<int32_t>(e));
}

void Emitters::join(Forest& forest, const Exposure& exposure) {
  if (emitters_.size() < worth_joining || !forest.clusters.empty()) return;
  std::vector<ClusterItem> items;
  for (const Emitter& e : emitters_)
    for (NodeId root : e.surfaces) items.push_back({root, e.center, e.radius});
  add_clusters(forest, items);
  of_node_.resize(forest.nodes.size(), -1);
  tops_.clear();
  const size_t singles = emitters_.size();
  find_groups(forest, exposure, forest.top(), -1);
  for (size_t e = 0; e < emitters_.size(); ++e) {
    const int32_t number = static_cast<int32_t>(e), group = emitters_[e].group;
    if (group < 0)
      tops_.push_back(number);
    else
      emitters_[group].parts.push_back(number);
    if (e >= singles) of_node_[emitters_[e].cluster] = number;
  }
}

// The numbers of the emitters that a cluster is made of, none where they don't make a group.
std::vector<int32_t> Emitters::members_of(const Forest& forest, const Cluster& cluster) const {
  if (cluster.cone > widest_group) return {};
  const int32_t* const first = &forest.clusters.order[cluster.first];
  std::vector<int32_t> members;
  for (const int32_t* root = first; root < first + cluster.count; ++root)
    members.push_back(of_node_[*root]);
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
  size_t surfaces = 0;
  for (int32_t member : members) {
    const Emitter& e = emitters_[member];
    surfaces += e.surfaces.size();
    if (e.brightness != emitters_[members.front()].brightness ||
        !shine_alike(*forest.scene, forest.surfaces[e.surfaces.front()], forest.surfaces[*first]))
      return {};
  }
  // Whole emitters only.
  const bool whole = surfaces == static_cast<size_t>(cluster.count);
  return whole && members.size() > 1 ? members : std::vector<int32_t>();
}

// Groups at or below a node, within the group `around`. Trees of clusters are flat enough.
void Emitters::find_groups(const Forest& forest, const Exposure& exposure, NodeId id,
                           int32_t around) {
  if (!Forest::is_cluster(forest.nodes[id])) return;
  const Cluster& cluster = forest.cluster(forest.nodes[id]);
  const std::vector<int32_t> members = members_of(forest, cluster);
  if (!members.empty()) {
    const int32_t number = static_cast<int32_t>(emitters_.size());
    Emitter group;
    group.normal = cluster.normal;
    group.brightness = emitters_[members.front()].brightness;
    group.cluster = id;
    group.members = members;
    group.group = around;
    for (int32_t member : members) {
      emitters_[member].group = number;
      const std::vector<NodeId>& surfaces = emitters_[member].surfaces;
      group.surfaces.insert(group.surfaces.end(), surfaces.begin(), surfaces.end());
    }
    finish(forest, exposure, group);
    for (int32_t member : members)
      group.thickness = std::max(
          group.thickness, std::fabs(dot(emitters_[member].center - group.center, group.normal)) +
                               widest_group * emitters_[member].radius);
    emitters_.push_back(std::move(group));
    around = number;
  }
  for (NodeId child : cluster.child) find_groups(forest, exposure, child, around);
}

double Emitters::largest_factor(const Emitter& e, Vec3 center, double radius) {
  const Vec3 d = e.center - center;
  const double above = radius + e.thickness - dot(d, e.normal);
  if (!(above > 0)) return 0;
  const double distance = std::max(length(d) - radius, e.radius);
  return std::min(1.0, e.area * std::min(1.0, above / distance) / (pi * distance * distance));
}

double Emitters::rough_factor(const Emitter& e, Vec3 x, Vec3 normal) {
  const Vec3 d = e.center - x;
  const double above = e.thickness - dot(d, e.normal);
  if (!(above > 0)) return 0;
  const double ahead = dot(d, normal) + e.radius;
  if (!(ahead > 0)) return 0;
  const double distance2 = std::max(dot(d, d), e.radius * e.radius);
  const double distance = std::sqrt(distance2);
  const double at_x = std::min(1.0, ahead / distance), at_emitter = std::min(1.0, above / distance);
  return std::min(1.0, e.area * at_x * at_emitter / (pi * distance2));
}

}  // namespace hrad
