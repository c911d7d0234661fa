// Roots, lattice places and geometry of the elements. Floor 5 (hierarchy).
#include "hierarchy/forest.h"

#include <utility>

namespace hrad {

Forest::Forest(const Scene& s) : scene(&s), first_surface_(s.patch_count(), -1) {
  for (int64_t patch = 0; patch < s.patch_count(); ++patch) {
    if (s.has(patch, patch_dropped) || s.has(patch, patch_blocker)) continue;
    const Vec3 vector = s.triangle(patch).area_vector();
    Surface surface;
    surface.patch = static_cast<int32_t>(patch);
    surface.normal = normalized(vector);
    surface.area = length(vector) / 2;
    first_surface_[patch] = static_cast<int32_t>(surfaces.size());
    surfaces.push_back(surface);
    if (!s.has(patch, patch_two_sided)) continue;
    surface.side = 1;
    surface.normal = -surface.normal;
    surfaces.push_back(surface);
  }
  nodes = NodeArray(surfaces.size());
}

Triangle Forest::root_triangle(int32_t surface) const {
  Triangle t = scene->triangle(surfaces[surface].patch);
  if (surfaces[surface].side) std::swap(t.b, t.c);
  return t;
}

Triangle Forest::triangle(const Node& n) const {
  const Triangle root = root_triangle(n.surface);
  if (n.level == 0) return root;
  const double step = 1.0 / static_cast<double>(1 << n.level);
  const double u = n.i * step, v = n.j * step;
  const Vec3 ab = root.b - root.a, ac = root.c - root.a;
  const Vec3 low = root.a + ab * u + ac * v;
  const Vec3 du = ab * step, dv = ac * step;
  if (!n.inverted) return {low, low + du, low + dv};
  return {low + du + dv, low + dv, low + du};
}

NodeId Forest::root(int64_t patch, int32_t side) const {
  const int32_t first = first_surface_[patch];
  if (first < 0) return -1;
  if (side == 0) return first;
  return scene->has(patch, patch_two_sided) ? first + 1 : -1;
}

// A look at a stem a level is all that memory has to serve.
NodeId Forest::leaf_at(NodeId root, double u, double v) const {
  WayDown way(u, v);
  NodeId id = root;
  for (NodeId first; (first = nodes.first_child(id)) >= 0;) id = first + way.next();
  return id;
}

NodeId Forest::root_met(const Hit& hit) const {
  return hit.patch < 0 ? -1 : root(hit.patch, hit.back ? 1 : 0);
}

NodeId Forest::leaf_met(const Hit& hit) const {
  const NodeId met = root_met(hit);
  if (met < 0) return -1;
  return hit.back ? leaf_at(met, hit.v, hit.u) : leaf_at(met, hit.u, hit.v);
}

void Forest::leaves_met(Span<const Hit> hits, NodeId* leaves) const {
  size_t going_down[most_met], count = 0;
  WayDown way[most_met];
  for (size_t k = 0; k < hits.size(); ++k) {
    leaves[k] = root_met(hits[k]);
    if (leaves[k] < 0) continue;
    nodes.prefetch(leaves[k]);
    way[k] = hits[k].back ? WayDown(hits[k].v, hits[k].u) : WayDown(hits[k].u, hits[k].v);
    going_down[count++] = k;
  }
  // All of them by one level.
  while (count > 0) {
    size_t left = 0;
    for (size_t at = 0; at < count; ++at) {
      const size_t k = going_down[at];
      const NodeId first = nodes.first_child(leaves[k]);
      if (first < 0) continue;
      leaves[k] = first + way[k].next();
      nodes.prefetch(leaves[k]);
      going_down[left++] = k;
    }
    count = left;
  }
}

double Forest::total_area() const {
  double area = 0;
  for (const Surface& surface : surfaces) area += surface.area;
  return area;
}

std::vector<NodeId> Forest::leaves() const {
  std::vector<NodeId> result, stack;
  result.reserve(static_cast<size_t>(leaf_count()));
  for (NodeId root = 0; root < surface_count(); ++root) {
    stack.push_back(root);
    while (!stack.empty()) {
      const NodeId id = stack.back();
      stack.pop_back();
      if (is_leaf(id)) {
        result.push_back(id);
        continue;
      }
      for (int child = 3; child >= 0; --child) stack.push_back(nodes.first_child(id) + child);
    }
  }
  return result;
}

}  // namespace hrad
