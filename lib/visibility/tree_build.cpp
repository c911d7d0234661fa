// Building the tree top down. A node is opened by splitting the largest of its
// ranges of triangles until there are eight. Large ranges are split by all
// threads together, in chunks of fixed size; small ones become subtrees, each
// built by one thread and put together in order. Neither depends on the number
// of threads. Floor 4 (visibility).
#include "visibility/tree_build.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/hash.h"
#include "visibility/split.h"

namespace hrad {

namespace {

constexpr int64_t leaf_size = tree_width;
// Ranges up to this are built by one thread: large enough to be worth a task,
// small enough for a hundred of them in a scene of a million.
constexpr int64_t subtree_size = 4096;
constexpr int64_t chunk_size = 16384;
// From here on ranges are halved by count, which ends within tree_max_depth.
constexpr int halving_depth = 40;

struct Builder {
  const Scene& scene;
  Vec3 center;
  float padding;
  ThreadTeam& team;
  std::vector<BuildItem> items, scratch;
};

struct Piece {
  Tree tree;
  uint32_t root = 0;
};

struct Task {
  BuildRange range;
  int depth = 0;
  uint32_t node = 0;  // whose child the piece becomes
  int slot = -1;      // -1: the piece is the whole tree
};

void corners_of(const Builder& builder, int32_t patch, float corner[3][3]) {
  const Triangle triangle = builder.scene.triangle(patch);
  const Vec3 points[3] = {triangle.a, triangle.b, triangle.c};
  for (int k = 0; k < 3; ++k) {
    const Vec3 p = points[k] - builder.center;
    corner[k][0] = static_cast<float>(p.x);
    corner[k][1] = static_cast<float>(p.y);
    corner[k][2] = static_cast<float>(p.z);
  }
}

// Calls body(chunk, first, last) for the chunks of fixed size that make up
// first..last.
template <class Body>
void for_chunks(ThreadTeam& team, int64_t begin, int64_t end, const Body& body) {
  const int64_t chunks = (end - begin + chunk_size - 1) / chunk_size;
  team.for_each(chunks, [&](int64_t chunk, int) {
    const int64_t first = begin + chunk * chunk_size;
    body(chunk, first, std::min(first + chunk_size, end));
  });
}

BuildRange make_items(Builder& builder) {
  const Scene& scene = builder.scene;
  for (int64_t patch = 0; patch < scene.patch_count(); ++patch) {
    if (scene.has(patch, patch_dropped)) continue;
    BuildItem item;
    item.patch = static_cast<int32_t>(patch);
    builder.items.push_back(item);
  }
  BuildRange range;
  range.end = static_cast<int64_t>(builder.items.size());
  for_chunks(builder.team, 0, range.end, [&](int64_t, int64_t first, int64_t last) {
    for (int64_t i = first; i < last; ++i) {
      float corner[3][3];
      corners_of(builder, builder.items[i].patch, corner);
      FloatBox box;
      for (const float* c : corner) box.grow(c, c);
      std::memcpy(builder.items[i].low, box.low, sizeof box.low);
      std::memcpy(builder.items[i].high, box.high, sizeof box.high);
    }
  });
  return range;
}

// measure() by all threads: minima and maxima may be joined in any order.
void measure_together(Builder& builder, BuildRange& range) {
  std::vector<BuildRange> parts((range.count() + chunk_size - 1) / chunk_size);
  for_chunks(builder.team, range.begin, range.end, [&](int64_t chunk, int64_t first, int64_t last) {
    parts[chunk].begin = first;
    parts[chunk].end = last;
    measure(builder.items.data(), parts[chunk]);
  });
  for (const BuildRange& part : parts) {
    range.box.grow(part.box);
    range.middles.grow(part.middles);
  }
}

Bins fill_together(Builder& builder, const BuildRange& range) {
  std::vector<Bins> parts((range.count() + chunk_size - 1) / chunk_size, Bins(range));
  for_chunks(builder.team, range.begin, range.end, [&](int64_t chunk, int64_t first, int64_t last) {
    parts[chunk].add(builder.items.data() + first, builder.items.data() + last);
  });
  for (size_t i = 1; i < parts.size(); ++i) parts[0].add(parts[i]);
  return parts[0];
}

// Moves the items for which goes_left(item) to the front, both sides keeping
// their order.
template <class Test>
void partition_together(Builder& builder, const BuildRange& range, const Test& goes_left) {
  const int64_t chunks = (range.count() + chunk_size - 1) / chunk_size;
  std::vector<int64_t> left(chunks, 0), right(chunks, 0);
  const BuildItem* items = builder.items.data();
  for_chunks(builder.team, range.begin, range.end, [&](int64_t chunk, int64_t first, int64_t last) {
    left[chunk] = std::count_if(items + first, items + last, goes_left);
    right[chunk] = last - first - left[chunk];
  });
  int64_t next = range.begin;
  for (int64_t& place : left) next += std::exchange(place, next);
  for (int64_t& place : right) next += std::exchange(place, next);
  BuildItem* out = builder.scratch.data();
  for_chunks(builder.team, range.begin, range.end, [&](int64_t chunk, int64_t first, int64_t last) {
    std::partition_copy(items + first, items + last, out + left[chunk], out + right[chunk],
                        goes_left);
  });
  for_chunks(builder.team, range.begin, range.end, [&](int64_t, int64_t first, int64_t last) {
    std::copy(out + first, out + last, builder.items.data() + first);
  });
}

// Splits the range in two. Ranges that fit in a leaf stay whole: kernels look
// at a leaf's triangles together, and sparse leaves cost more in memory traffic
// than their tighter boxes save.
void split(Builder& builder, const BuildRange& range, int depth, BuildRange& left,
           BuildRange& right) {
  const bool together = range.count() > subtree_size;
  BuildItem* items = builder.items.data();
  left = right = BuildRange();
  Bins bins(range);
  Bins::Cut cut;
  if (depth < halving_depth) {
    if (together)
      bins = fill_together(builder, range);
    else
      bins.add(items + range.begin, items + range.end);
    cut = bins.best();
  }
  int64_t middle;
  if (cut.axis < 0) {  // halve by count: in the order given
    middle = range.begin + range.count() / 2;
  } else {
    middle = range.begin + cut.left_count;
    const auto goes_left = [&](const BuildItem& item) {
      return bins.bin_of(item, cut.axis) < cut.bin;
    };
    if (together)
      partition_together(builder, range, goes_left);
    else
      std::partition(items + range.begin, items + range.end, goes_left);
  }
  left.begin = range.begin;
  left.end = right.begin = middle;
  right.end = range.end;
  for (BuildRange* side : {&left, &right}) {
    if (side->count() > subtree_size)
      measure_together(builder, *side);
    else
      measure(items, *side);
  }
}

bool is_leaf(const BuildRange& range) { return range.count() <= leaf_size; }

// The ranges of a node's children: the largest is split until there are eight
// or all fit in leaves.
int open_node(Builder& builder, const BuildRange& range, int depth, BuildRange* children) {
  int count = 1;
  children[0] = range;
  while (count < tree_width) {
    int largest = -1;
    for (int i = 0; i < count; ++i) {
      if (is_leaf(children[i])) continue;
      if (largest < 0 || children[i].box.area() > children[largest].box.area()) largest = i;
    }
    if (largest < 0) break;
    BuildRange left, right;
    split(builder, children[largest], depth, left, right);
    children[largest] = left;
    children[count++] = right;
  }
  return count;
}

TreeNode empty_node() {
  TreeNode node;
  for (int axis = 0; axis < 3; ++axis) {
    std::fill(node.low[axis], node.low[axis] + tree_width, tree_nowhere);
    std::fill(node.high[axis], node.high[axis] + tree_width, -tree_nowhere);
  }
  std::fill(node.child, node.child + tree_width, 0u);
  return node;
}

void set_box(const Builder& builder, const FloatBox& box, int slot, TreeNode& node) {
  for (int axis = 0; axis < 3; ++axis) {
    node.low[axis][slot] = box.low[axis] - builder.padding;
    node.high[axis][slot] = box.high[axis] + builder.padding;
  }
}

uint32_t add_leaf(Builder& builder, const BuildRange& range, Tree& tree) {
  // In ascending order of patches, whatever splitting has made of it.
  std::sort(builder.items.begin() + range.begin, builder.items.begin() + range.end,
            [](const BuildItem& a, const BuildItem& b) { return a.patch < b.patch; });
  TreeLeaf leaf = {};
  std::fill_n(&leaf.corner[0][0][0], sizeof leaf.corner / sizeof(float), tree_nowhere);
  std::fill_n(leaf.patch, tree_width, -1);
  for (int64_t i = 0; i < range.count(); ++i) {
    const int32_t patch = builder.items[range.begin + i].patch;
    float corner[3][3];
    corners_of(builder, patch, corner);
    const Vec3 normal = normalized(builder.scene.triangle(patch).area_vector());
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < 3; ++k) leaf.corner[k][axis][i] = corner[k][axis];
      leaf.normal[axis][i] = static_cast<float>(normal[axis]);
    }
    leaf.patch[i] = patch;
  }
  tree.leaves.push_back(leaf);
  return leaf_reference(static_cast<uint32_t>(tree.leaves.size() - 1),
                        static_cast<uint32_t>(range.count()));
}

uint32_t build_subtree(Builder& builder, const BuildRange& range, int depth, Tree& tree) {
  const uint32_t number = static_cast<uint32_t>(tree.nodes.size());
  tree.nodes.push_back(empty_node());
  BuildRange children[tree_width];
  const int count = open_node(builder, range, depth, children);
  for (int i = 0; i < count; ++i) {
    if (children[i].count() == 0) continue;  // the root of nothing
    set_box(builder, children[i].box, i, tree.nodes[number]);
    const uint32_t child = is_leaf(children[i])
                               ? add_leaf(builder, children[i], tree)
                               : build_subtree(builder, children[i], depth + 1, tree);
    tree.nodes[number].child[i] = child;
  }
  return number;
}

// Nodes above the subtrees.
uint32_t build_top(Builder& builder, const BuildRange& range, int depth, Tree& tree,
                   std::vector<Task>& tasks) {
  const uint32_t number = static_cast<uint32_t>(tree.nodes.size());
  tree.nodes.push_back(empty_node());
  BuildRange children[tree_width];
  const int count = open_node(builder, range, depth, children);
  for (int i = 0; i < count; ++i) {
    set_box(builder, children[i].box, i, tree.nodes[number]);
    if (children[i].count() > subtree_size) {
      const uint32_t child = build_top(builder, children[i], depth + 1, tree, tasks);
      tree.nodes[number].child[i] = child;
    } else {
      tasks.push_back({children[i], depth + 1, number, i});
    }
  }
  return number;
}

// Appends a piece to the tree; returns its root there.
uint32_t append(Tree& tree, const Piece& piece) {
  const uint32_t nodes = static_cast<uint32_t>(tree.nodes.size());
  const uint32_t leaves = static_cast<uint32_t>(tree.leaves.size());
  const auto moved = [&](uint32_t child) {
    return child + (child & tree_leaf_bit ? leaves << 3 : nodes);
  };
  for (TreeNode node : piece.tree.nodes) {
    for (uint32_t& child : node.child) child = moved(child);
    tree.nodes.push_back(node);
  }
  tree.leaves.insert(tree.leaves.end(), piece.tree.leaves.begin(), piece.tree.leaves.end());
  return moved(piece.root);
}

}  // namespace

Tree build_tree(const Scene& scene, Vec3 center, float padding, ThreadTeam& team) {
  Builder builder{scene, center, padding, team, {}, {}};
  BuildRange range = make_items(builder);
  measure_together(builder, range);
  Tree tree;
  std::vector<Task> tasks;
  if (range.count() > subtree_size) {
    builder.scratch.resize(builder.items.size());
    build_top(builder, range, 0, tree, tasks);
    std::vector<BuildItem>().swap(builder.scratch);
  } else {
    tasks.push_back({range, 0, 0, -1});
  }
  std::vector<Piece> pieces(tasks.size());
  team.for_each(static_cast<int64_t>(tasks.size()), [&](int64_t i, int) {
    const Task& task = tasks[i];
    Piece& piece = pieces[i];
    piece.root = task.slot >= 0 && is_leaf(task.range)
                     ? add_leaf(builder, task.range, piece.tree)
                     : build_subtree(builder, task.range, task.depth, piece.tree);
  });
  size_t nodes = tree.nodes.size(), leaves = 0;
  for (const Piece& piece : pieces) {
    nodes += piece.tree.nodes.size();
    leaves += piece.tree.leaves.size();
  }
  tree.nodes.reserve(nodes);
  tree.leaves.reserve(leaves);
  for (size_t i = 0; i < tasks.size(); ++i) {
    const uint32_t root = append(tree, pieces[i]);
    if (tasks[i].slot >= 0) tree.nodes[tasks[i].node].child[tasks[i].slot] = root;
    pieces[i] = Piece();
  }
  return tree;
}

uint64_t hash_of(const Tree& tree) {
  Hasher hasher;
  for (const TreeNode& node : tree.nodes) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < tree_width; ++i) {
        hasher.add(node.low[axis][i]);
        hasher.add(node.high[axis][i]);
      }
    }
    for (uint32_t child : node.child) hasher.add(uint64_t{child});
  }
  for (const TreeLeaf& leaf : tree.leaves)
    for (int32_t patch : leaf.patch) hasher.add(static_cast<uint64_t>(patch));
  return hasher.value();
}

}  // namespace hrad
