// What a task of refinement has made, as a result in the journal and back. Floor 7 (stages).
#pragma once

#include "stages/link_journal.h"
#include "stages/subtree_refiner.h"

namespace hrad {

void add_result(LinkStep& step, uint64_t name, const SubtreeResult& result);

// nodes: those that the round began with, from which links come. False: the result is not one of a
// task with this root.
bool take_result(KnownResult& known, const Forest& forest, NodeId root, size_t nodes,
                 SubtreeResult& result);

}  // namespace hrad
