// Elements come in families of four; a family's parent says all of its shape. Floor 8 (solver).
#include "solver/checkpoint_tree.h"

#include <cstdint>

namespace hrad {
namespace {

// What a node's exposure is told from: its parent's.
float expected_exposure(const Forest& forest, int64_t node) {
  const Node& n = forest.nodes[static_cast<size_t>(node)];
  return n.level > 0 ? forest.nodes[static_cast<size_t>(n.parent)].exposed : 1.0f;
}

// Exposed area of the surfaces before each in the order of the clusters, as it would be now.
std::vector<double> present_areas(const Forest& forest) {
  std::vector<double> before(1, 0.0);
  for (int32_t surface : forest.clusters.order)
    before.push_back(before.back() + forest.surfaces[static_cast<size_t>(surface)].area *
                                         forest.nodes[static_cast<size_t>(surface)].exposed);
  return before;
}

}  // namespace

void pack_families(const Forest& forest, int64_t first, int64_t end, PackedBytes& bytes) {
  const int64_t base = static_cast<int64_t>(forest.nodes.first_element());
  int64_t before = 0;
  for (int64_t family = first; family < end; ++family) {
    const int64_t parent = forest.nodes[static_cast<size_t>(base + 4 * family)].parent;
    bytes.signed_varint(parent - before);
    before = parent;
  }
}

void unpack_families(PackedReader& bytes, int64_t first, int64_t end, Forest& forest) {
  int64_t parent = 0;
  for (int64_t family = first; family < end; ++family) {
    const auto child = static_cast<NodeId>(forest.nodes.size());
    parent = bytes.moved(parent, "the parent of four elements", 0, child - 1);
    const Node& above = forest.nodes[static_cast<size_t>(parent)];
    if (Forest::is_cluster(above) || above.first_child >= 0 || above.level >= max_level)
      fail_format(bytes.place(), "element %lld can't have the children %d to %d: it %s",
                  static_cast<long long>(parent), child, child + 3,
                  Forest::is_cluster(above) ? "is a cluster"
                  : above.first_child >= 0  ? "has four already"
                                            : "is as small as elements can be");
    forest.nodes.resize(forest.nodes.size() + 4);
    forest.nodes.adopt(static_cast<NodeId>(parent), child);
  }
}

void pack_nodes(const Forest& forest, int64_t first, int64_t end, PackedBytes& bytes) {
  std::vector<uint32_t> changes;
  for (int64_t k = first; k < end; ++k) {
    const Node& node = forest.nodes[static_cast<size_t>(k)];
    bytes.byte(node.light_points);
    changes.push_back(zigzag32(bits_of(node.exposed) - bits_of(expected_exposure(forest, k))));
  }
  bytes.planes(changes);
}

void unpack_nodes(PackedReader& bytes, int64_t first, int64_t end, Forest& forest) {
  for (int64_t k = first; k < end; ++k) {
    const uint8_t points = bytes.byte();
    if (points > at_own_points)
      fail_format(bytes.place(), "node %lld has its light at places of kind %d",
                  static_cast<long long>(k), points);
    forest.nodes.set_light_points(static_cast<size_t>(k), static_cast<LightPoints>(points));
  }
  std::vector<uint32_t> changes;
  bytes.planes(static_cast<size_t>(end - first), changes);
  for (int64_t k = first; k < end; ++k) {
    const uint32_t expected = bits_of(expected_exposure(forest, k));
    const float exposed =
        float_of(expected + from_zigzag32(changes[static_cast<size_t>(k - first)]));
    if (!(exposed >= 0 && exposed <= 1))
      fail_format(bytes.place(), "the exposed share of node %lld is %g: it must be from 0 to 1",
                  static_cast<long long>(k), static_cast<double>(exposed));
    forest.nodes.set_exposed(static_cast<size_t>(k), exposed);
  }
}

void pack_clusters(const Forest& forest, PackedBytes& bytes) {
  const ClusterTree& tree = forest.clusters;
  int64_t before = 0;
  for (int32_t surface : tree.order) {
    bytes.signed_varint(surface - before);
    before = surface;
  }
  for (const Cluster& cluster : tree.clusters) {
    const Node& first = forest.nodes[static_cast<size_t>(cluster.child[0])];
    bytes.varint(Forest::is_cluster(first) ? static_cast<uint64_t>(forest.cluster(first).count)
                                           : 1u);
  }
  const std::vector<double> present = present_areas(forest);
  std::vector<uint64_t> changes;
  for (size_t k = 0; k < present.size(); ++k)
    changes.push_back(bits_of(tree.area_before[k]) ^ bits_of(present[k]));
  bytes.planes(changes);
}

void unpack_clusters(PackedReader& bytes, int64_t clusters, Forest& forest) {
  std::vector<int32_t> order, left;
  std::vector<uint8_t> seen(static_cast<size_t>(forest.surface_count()));
  int64_t surface = 0;
  for (int64_t k = 0; k <= clusters; ++k) {
    surface = bytes.moved(surface, "a surface of a cluster", 0, forest.surface_count() - 1);
    if (seen[static_cast<size_t>(surface)]++ > 0)
      fail_format(bytes.place(), "surface %lld is in two clusters",
                  static_cast<long long>(surface));
    order.push_back(static_cast<int32_t>(surface));
  }
  for (int64_t k = 0; k < clusters; ++k)
    left.push_back(static_cast<int32_t>(bytes.count("the surfaces of a half", 1, clusters)));
  forest.clusters.clusters.clear();  // they stood for the nodes so far
  if (!restore_clusters(forest, std::move(order), left))
    fail_format(bytes.place(), "its halves of clusters make no tree");
  ClusterTree& tree = forest.clusters;
  std::vector<uint64_t> changes;
  const std::vector<double> present = present_areas(forest);
  bytes.planes(present.size(), changes);
  tree.area_before.clear();
  for (size_t k = 0; k < present.size(); ++k) {
    const double area = double_of(changes[k] ^ bits_of(present[k]));
    // The last one is finite, as is the sum of all surfaces.
    if (!(area >= (k > 0 ? tree.area_before.back() : 0) && area <= 2 * forest.total_area()))
      fail_format(bytes.place(), "the exposed areas of surfaces don't ascend: %g", area);
    tree.area_before.push_back(area);
  }
  for (Cluster& c : tree.clusters)
    c.area = tree.area_before[c.first + c.count] - tree.area_before[c.first];
}

void pack_cells(const std::vector<NodeId>& cells, int64_t first, int64_t end, PackedBytes& bytes) {
  int64_t before = -1;
  for (int64_t k = first; k < end; ++k) {
    bytes.signed_varint(cells[static_cast<size_t>(k)] - before - 1);
    before = cells[static_cast<size_t>(k)];
  }
}

void unpack_cells(PackedReader& bytes, int64_t first, int64_t end, NodeId nodes,
                  std::vector<NodeId>& cells) {
  int64_t cell = -1;
  for (int64_t k = first; k < end; ++k) {
    cell = bytes.moved(cell + 1, "a cell", 0, nodes - 1);
    if (!cells.empty() && cell <= cells.back())
      fail_format(bytes.place(), "cell %lld follows cell %d: they must ascend",
                  static_cast<long long>(cell), cells.back());
    cells.push_back(static_cast<NodeId>(cell));
  }
}

void check_cover(const Forest& forest, const std::vector<NodeId>& cells, const FilePlace& place) {
  std::vector<uint8_t> covered(forest.nodes.size());
  for (NodeId cell : cells) covered[static_cast<size_t>(cell)] = 1;
  // Parents come before their children.
  for (size_t k = 0; k < covered.size(); ++k) {
    const Node& node = forest.nodes[k];
    if (Forest::is_cluster(node)) {
      if (covered[k]) fail_format(place, "cell %zu is a cluster", k);
      continue;
    }
    const bool above = node.level > 0 && covered[static_cast<size_t>(node.parent)];
    if (covered[k] && above) fail_format(place, "cell %zu lies within another", k);
    covered[k] = covered[k] || above;
    if (!covered[k] && node.first_child < 0) fail_format(place, "leaf %zu lies in no cell", k);
  }
}

}  // namespace hrad
