// Building the tree from the top: by normals until they are alike, then by size, then by place.
// Floor 5 (hierarchy).
#include "hierarchy/clusters.h"

#include <algorithm>
#include <utility>

#include "base/angle.h"
#include "hierarchy/forest.h"

namespace hrad {
namespace {

// A surface that fills so much of its cluster's radius is large beside those less than half its
// size, and parted from them: a floor from the things that stand on it.
constexpr double large_share = 1.0 / 3;
// Below so many levels clusters are halved by count: no scene makes the tree deeper than that and
// the logarithm of its patches.
constexpr int deepest_by_place = 48;
// Normals and sizes halve their ranges at each level, so that none is as deep as this.
constexpr int deepest = 2000;

int longest_axis(Vec3 extent) {
  if (extent.x >= extent.y && extent.x >= extent.z) return 0;
  return extent.y >= extent.z ? 1 : 2;
}

struct Piece {
  int32_t first, count;
  int32_t parent;  // cluster, -1: the first one
  int slot;
  int depth;
};

class Builder {
 public:
  // left: of the first child of every cluster, where that is known already.
  Builder(Forest& forest, const std::vector<int32_t>* left)
      : forest_(forest), tree_(forest.clusters), left_(left) {}
  Builder(Forest& forest, const std::vector<ClusterItem>& items)
      : forest_(forest),
        tree_(forest.clusters),
        centroid_(static_cast<size_t>(forest.surface_count())),
        size_(centroid_.size()) {
    for (const ClusterItem& item : items) {
      tree_.order.push_back(item.surface);
      centroid_[item.surface] = item.place;
      size_[item.surface] = item.size;
    }
  }

  // False: left is not that of a tree.
  bool build() {
    std::vector<Piece> stack{{0, static_cast<int32_t>(tree_.order.size()), -1, 0, 0}};
    while (!stack.empty()) {
      const Piece piece = stack.back();
      stack.pop_back();
      const int32_t number = static_cast<int32_t>(tree_.clusters.size());
      const NodeId id = piece.count == 1 ? tree_.order[piece.first]
                                         : static_cast<NodeId>(forest_.surface_count()) + number;
      if (piece.parent >= 0) {
        tree_.clusters[piece.parent].child[piece.slot] = id;
        forest_.nodes.set_parent_of_top(
            id, static_cast<NodeId>(forest_.surface_count()) + piece.parent);
      }
      if (piece.count == 1) continue;
      const Cluster cluster = bounds_of(piece);
      tree_.clusters.push_back(cluster);
      const int32_t left = left_ ? (*left_)[number] : divide(piece, cluster);
      if (left < 1 || left >= piece.count || piece.depth > deepest) return false;
      stack.push_back({piece.first + left, piece.count - left, number, 1, piece.depth + 1});
      stack.push_back({piece.first, left, number, 0, piece.depth + 1});
    }
    return true;
  }

  // Once the order is final, in which a tree is also made again: sums depend on it.
  void measure_again() {
    for (Cluster& cluster : tree_.clusters) {
      Cluster bounds = bounds_of({cluster.first, cluster.count, -1, 0, 0});
      std::copy(cluster.child, cluster.child + 2, bounds.child);
      cluster = bounds;
    }
  }

 private:
  const Vec3& normal(int32_t surface) const { return forest_.surfaces[surface].normal; }

  template <class F>
  void for_corners(const Piece& piece, F&& f) const {
    for (int32_t k = piece.first; k < piece.first + piece.count; ++k) {
      const Triangle t = forest_.root_triangle(tree_.order[k]);
      f(t.a);
      f(t.b);
      f(t.c);
    }
  }

  Cluster bounds_of(const Piece& piece) const {
    Cluster c;
    c.first = piece.first;
    c.count = piece.count;
    Vec3 sum;
    for (int32_t k = piece.first; k < piece.first + piece.count; ++k)
      sum = sum + normal(tree_.order[k]) * forest_.surfaces[tree_.order[k]].area;
    c.normal = normalized(sum);
    for (int32_t k = piece.first; k < piece.first + piece.count; ++k) {
      const Vec3& n = normal(tree_.order[k]);
      c.cone = std::max(c.cone, angle_of(length(cross(c.normal, n)), dot(c.normal, n)));
    }
    if (!(dot(c.normal, c.normal) > 0)) c.cone = pi;
    Box box;
    for_corners(piece, [&](Vec3 p) { box.grow(p); });
    c.center = box.center();
    double low = 1e300, high = -1e300;
    for_corners(piece, [&](Vec3 p) {
      const double height = dot(c.normal, p - c.center);
      low = std::min(low, height);
      high = std::max(high, height);
    });
    c.thickness = (high - low) / 2;
    c.center = c.center + c.normal * ((low + high) / 2);
    double square = 0;
    for_corners(piece, [&](Vec3 p) { square = std::max(square, dot(p - c.center, p - c.center)); });
    c.radius = std::sqrt(square);
    return c;
  }

  // Orders the piece's surfaces into two parts; the count of the first.
  int32_t divide(const Piece& piece, const Cluster& cluster) {
    int32_t* first = &tree_.order[piece.first];
    int32_t* last = first + piece.count;
    const auto part = [&](auto&& is_first) {
      return static_cast<int32_t>(std::stable_partition(first, last, is_first) - first);
    };
    if (!cluster.linkable()) {
      Box box;
      for (const int32_t* s = first; s < last; ++s) box.grow(normal(*s));
      const int axis = longest_axis(box.extent());
      const double middle = box.center()[axis];
      return part([&](int32_t s) { return normal(s)[axis] < middle; });
    }
    double largest = 0, smallest = 1e300;
    Box box;
    for (const int32_t* s = first; s < last; ++s) {
      largest = std::max(largest, size_[*s]);
      smallest = std::min(smallest, size_[*s]);
      box.grow(centroid_[*s]);
    }
    if (largest > large_share * cluster.radius && smallest < largest / 2)
      return part([&](int32_t s) { return size_[s] >= largest / 2; });
    const int axis = longest_axis(box.extent());
    const double middle = box.center()[axis];
    if (box.low[axis] < middle && piece.depth < deepest_by_place)
      return part([&](int32_t s) { return centroid_[s][axis] < middle; });
    std::stable_sort(first, last,
                     [&](int32_t a, int32_t b) { return centroid_[a][axis] < centroid_[b][axis]; });
    return piece.count / 2;
  }

  Forest& forest_;
  ClusterTree& tree_;
  std::vector<Vec3> centroid_;  // per surface
  std::vector<double> size_;    // radius around the centroid
  const std::vector<int32_t>* left_ = nullptr;
};

}  // namespace

void add_clusters(Forest& forest) {
  std::vector<ClusterItem> items;
  for (int32_t k = 0; k < static_cast<int32_t>(forest.surface_count()); ++k) {
    const Triangle t = forest.root_triangle(k);
    const Vec3 centroid = t.centroid();
    double square = 0;
    for (const Vec3& p : {t.a, t.b, t.c})
      square = std::max(square, dot(p - centroid, p - centroid));
    items.push_back({k, centroid, std::sqrt(square)});
  }
  add_clusters(forest, items);
}

void add_clusters(Forest& forest, const std::vector<ClusterItem>& items) {
  if (items.size() < 2) return;
  forest.nodes.add_clusters(items.size() - 1);
  Builder builder(forest, items);
  builder.build();
  builder.measure_again();
  measure_clusters(forest);
}

bool restore_clusters(Forest& forest, std::vector<int32_t> order,
                      const std::vector<int32_t>& left) {
  forest.clusters.order = std::move(order);
  return Builder(forest, &left).build();
}

void measure_clusters(Forest& forest) {
  ClusterTree& tree = forest.clusters;
  tree.area_before.assign(1, 0.0);
  for (int32_t surface : tree.order)
    tree.area_before.push_back(tree.area_before.back() +
                               forest.surfaces[surface].area * forest.nodes[surface].exposed);
  for (Cluster& c : tree.clusters)
    c.area = tree.area_before[c.first + c.count] - tree.area_before[c.first];
  for (size_t c = 0; c < tree.clusters.size(); ++c)
    forest.nodes.set_exposed(forest.surface_count() + c, tree.clusters[c].area > 0 ? 1.0f : 0.0f);
}

}  // namespace hrad
