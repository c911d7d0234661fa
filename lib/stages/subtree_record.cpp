// Elements come in families of four: of each its parent is kept, and of new ones what is exposed.
// Floor 7 (stages).
#include "stages/subtree_record.h"

#include <algorithm>
#include <utility>

namespace hrad {
namespace {

struct Head {
  int64_t rays;
  uint32_t families;
  uint32_t handed_on;
};
struct Family {
  int32_t parent;  // index into SubtreeResult::nodes
  uint32_t is_new;
  float exposed[4];  // of new ones
};

Family family_of(const SubtreeResult& result, size_t at) {
  Family family = {result.nodes[at].parent, result.nodes[at].old_id < 0, {}};
  for (size_t child = 0; child < 4 && family.is_new != 0; ++child)
    family.exposed[child] = result.nodes[at + child].place.exposed;
  return family;
}

bool is_share(float value) { return value >= 0 && value <= 1; }

// False: there can be no such family.
bool add_family(const Family& family, const Forest& forest, SubtreeResult& result) {
  if (family.parent < 0 || static_cast<size_t>(family.parent) >= result.nodes.size()) return false;
  const Node parent = result.nodes[static_cast<size_t>(family.parent)].place;
  const bool is_new = parent.first_child < 0;
  if (result.nodes[static_cast<size_t>(family.parent)].first_child >= 0 ||
      parent.level >= max_level || is_new != (family.is_new != 0) ||
      !std::all_of(family.exposed, family.exposed + 4, is_share))
    return false;
  result.nodes[static_cast<size_t>(family.parent)].first_child =
      static_cast<int32_t>(result.nodes.size());
  for (int child = 0; child < 4; ++child) {
    SubtreeNode node;
    node.parent = family.parent;
    if (is_new) {
      node.place = child_place(parent, child);
      node.place.exposed = family.exposed[child];
    } else {
      node.old_id = parent.first_child + child;
      node.place = forest.nodes[static_cast<size_t>(node.old_id)];
    }
    result.nodes.push_back(std::move(node));
  }
  return true;
}

}  // namespace

void add_result(LinkStep& step, uint64_t name, const SubtreeResult& result) {
  const size_t families = (result.nodes.size() - 1) / 4;
  const Head head = {result.rays, static_cast<uint32_t>(families), result.handed_on};
  put(step.results, &head, 1);
  for (size_t k = 0; k < families; ++k) {
    const Family family = family_of(result, 1 + 4 * k);
    put(step.results, &family, 1);
  }
  for (size_t at = 0; at < result.nodes.size(); ++at) {
    const SubtreeNode& node = result.nodes[at];
    if (!result.handed_on || at == 0) {
      put_list(step.results, node.run);
    } else {
      put_list(step.results, node.arriving);
      put_list(step.results, node.meeting);
    }
  }
  step.end_task(name);
}

bool take_result(KnownResult& known, const Forest& forest, NodeId root, size_t nodes,
                 SubtreeResult& taken) {
  const auto is_source = [&](NodeId id) { return id >= 0 && static_cast<size_t>(id) < nodes; };
  Head head;
  if (!known.take(&head, 1) || !is_count(head.rays) || head.handed_on > 1 ||
      (head.handed_on == 1 && head.families != 1))
    return false;
  SubtreeResult result;
  result.rays = head.rays;
  result.handed_on = head.handed_on == 1;
  result.nodes.emplace_back();
  result.nodes[0].place = forest.nodes[static_cast<size_t>(root)];
  result.nodes[0].old_id = root;
  for (uint32_t k = 0; k < head.families; ++k) {
    Family family;
    if (!known.take(&family, 1) || !add_family(family, forest, result)) return false;
  }
  for (size_t at = 0; at < result.nodes.size(); ++at) {
    SubtreeNode& node = result.nodes[at];
    const bool has_run = !result.handed_on || at == 0;
    std::vector<Link>& links = has_run ? node.run : node.arriving;
    if (!known.take_list(links) || !are_links(links, is_source)) return false;
    if (!has_run && !(known.take_list(node.meeting) &&
                      std::all_of(node.meeting.begin(), node.meeting.end(), is_source)))
      return false;
  }
  if (!known.at_end()) return false;
  taken = std::move(result);
  return true;
}

}  // namespace hrad
