// Runs of links as bytes of a checkpoint and back (hrad-checkpoint(5), "Runs of links").
// Floor 8 (solver).
#pragma once

#include <cstdint>
#include <functional>

#include "base/span.h"
#include "links/link.h"
#include "solver/packed_bytes.h"

namespace hrad {

using RunOf = std::function<Span<const Link>(int64_t receiver)>;
void pack_runs(int64_t first, int64_t end, const RunOf& run_of, PackedBytes& bytes);

// sources: nodes from this one on can't send. left: links that the whole section may still have.
// take: is handed the runs in order.
void unpack_runs(int64_t first, int64_t end, NodeId sources, int64_t& left, PackedReader& bytes,
                 const std::function<void(Span<const Link>)>& take);

}  // namespace hrad
