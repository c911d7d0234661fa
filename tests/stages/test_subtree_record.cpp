// The record of a task of refinement gives back what the task made; bytes that no task could have
// made, which a file may hold, are not taken.
#include <cmath>
#include <functional>
#include <vector>

#include "stages/subtree_record.h"
#include "support/check.h"
#include "support/workbench.h"

using namespace hrad;
using namespace hrad_test;

namespace {

// A new family below the root, another below its first child, and a link on each element.
SubtreeResult two_families(const Forest& forest) {
  SubtreeResult result;
  result.rays = 77;
  result.nodes.emplace_back();
  result.nodes[0].place = forest.nodes[0];
  result.nodes[0].old_id = 0;
  for (int32_t parent : {0, 1}) {
    result.nodes[static_cast<size_t>(parent)].first_child =
        static_cast<int32_t>(result.nodes.size());
    for (int child = 0; child < 4; ++child) {
      SubtreeNode node;
      node.place = child_place(result.nodes[static_cast<size_t>(parent)].place, child);
      node.place.exposed = 0.25f * static_cast<float>(child);
      node.parent = parent;
      result.nodes.push_back(node);
    }
  }
  for (SubtreeNode& node : result.nodes) node.run = {{1, 0.5f}};
  return result;
}

Bytes bytes_of_record(const SubtreeResult& result) {
  LinkStep step;
  add_result(step, 1, result);
  return step.results;
}

bool is_taken(const Bytes& bytes, const Forest& forest, SubtreeResult& taken) {
  KnownResult known(bytes.data(), bytes.size());
  return take_result(known, forest, 0, forest.nodes.size(), taken);
}

void what_was_made_is_given_back() {
  const Workbench bench(builtin_scene("cornell"));
  const Forest& forest = bench.state.forest;
  const SubtreeResult made = two_families(forest);
  SubtreeResult taken;
  CHECK(is_taken(bytes_of_record(made), forest, taken));
  CHECK_EQUAL(taken.rays, made.rays);
  CHECK_EQUAL(taken.nodes.size(), made.nodes.size());
  for (size_t k = 0; k < made.nodes.size(); ++k) {
    CHECK_EQUAL(taken.nodes[k].parent, made.nodes[k].parent);
    CHECK_EQUAL(taken.nodes[k].first_child, made.nodes[k].first_child);
    CHECK_EQUAL(taken.nodes[k].place.exposed, made.nodes[k].place.exposed);
    CHECK_EQUAL(taken.nodes[k].run.size(), size_t{1});
  }
}

void what_no_task_can_have_made_is_not_taken() {
  const Workbench bench(builtin_scene("cornell"));
  const Forest& forest = bench.state.forest;
  const auto is_refused = [&](const std::function<void(SubtreeResult&)>& change) {
    SubtreeResult made = two_families(forest), taken;
    change(made);
    CHECK(!is_taken(bytes_of_record(made), forest, taken));
    CHECK(taken.nodes.empty());
  };
  const auto second = [](SubtreeResult& made) -> SubtreeNode& { return made.nodes[5]; };
  is_refused([&](SubtreeResult& made) { second(made).parent = -1; });
  is_refused([&](SubtreeResult& made) { second(made).parent = 5; });  // its own
  is_refused([&](SubtreeResult& made) { second(made).parent = 0; });  // that has four already
  is_refused([&](SubtreeResult& made) { second(made).old_id = 3; });  // old, below a new one
  for (float share : {-0.5f, 1.5f, std::nanf("")})
    is_refused([&](SubtreeResult& made) { second(made).place.exposed = share; });
  is_refused([&](SubtreeResult& made) { made.rays = -1; });
  is_refused([&](SubtreeResult& made) { made.nodes[3].run[0].source = -1; });
  is_refused([&](SubtreeResult& made) {
    made.nodes[3].run[0].source = static_cast<NodeId>(forest.nodes.size());
  });
}

// Of a root whose children are tasks of the next pass, with the sources that these are yet to meet.
void what_is_handed_on_comes_from_nodes_that_there_are() {
  const Workbench bench(builtin_scene("cornell"));
  const Forest& forest = bench.state.forest;
  SubtreeResult made = two_families(forest), taken;
  made.nodes.resize(5);
  made.nodes[1].first_child = -1;
  made.handed_on = true;
  for (int child = 1; child < 5; ++child) made.nodes[static_cast<size_t>(child)].meeting = {2};
  CHECK(is_taken(bytes_of_record(made), forest, taken));
  CHECK(taken.handed_on);
  CHECK_EQUAL(taken.nodes[4].meeting.size(), size_t{1});
  made.nodes[4].meeting = {static_cast<NodeId>(forest.nodes.size())};
  SubtreeResult none;
  CHECK(!is_taken(bytes_of_record(made), forest, none));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(what_was_made_is_given_back),
                              HRAD_TEST(what_no_task_can_have_made_is_not_taken),
                              HRAD_TEST(what_is_handed_on_comes_from_nodes_that_there_are)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
