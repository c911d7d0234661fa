// The hierarchy as sections of a checkpoint and back: elements, what is known of each node,
// clusters, cells. Shapes are such that every file that can be read is a forest. Floor 8 (solver).
#pragma once

#include <vector>

#include "hierarchy/forest.h"
#include "solver/packed_bytes.h"

namespace hrad {

// Families of four elements, from the first behind roots and clusters on; unpacking appends them.
void pack_families(const Forest& forest, int64_t first, int64_t end, PackedBytes& bytes);
void unpack_families(PackedReader& bytes, int64_t first, int64_t end, Forest& forest);

// Exposure and places of light of nodes first .. end-1.
void pack_nodes(const Forest& forest, int64_t first, int64_t end, PackedBytes& bytes);
void unpack_nodes(PackedReader& bytes, int64_t first, int64_t end, Forest& forest);

void pack_clusters(const Forest& forest, PackedBytes& bytes);
void unpack_clusters(PackedReader& bytes, int64_t clusters, Forest& forest);

void pack_cells(const std::vector<NodeId>& cells, int64_t first, int64_t end, PackedBytes& bytes);
void unpack_cells(PackedReader& bytes, int64_t first, int64_t end, NodeId nodes,
                  std::vector<NodeId>& cells);
// FORMAT unless every leaf has one cell above it, or is one.
void check_cover(const Forest& forest, const std::vector<NodeId>& cells, const FilePlace& place);

}  // namespace hrad
