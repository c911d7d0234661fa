// Everybody's processors, compared. Floor 2 (machine).
#include "machine/crowd.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "machine/sharing.h"

namespace hrad {
namespace {

struct Processor {
  int32_t node, number, rank;
};

}  // namespace

int sharers_of_processors(Comm& comm, const Topology& topology) {
  if (comm.alone()) return 1;
  std::vector<Processor> own;
  for (const std::vector<int>& core : topology.core_contexts)
    for (int context : core) own.push_back({comm.node(), context, comm.rank()});
  std::vector<Processor> all = own;
  unite(comm, all);
  std::vector<uint8_t> shares(static_cast<size_t>(comm.size()), 0);
  shares[static_cast<size_t>(comm.rank())] = 1;
  for (const Processor& p : all)
    shares[static_cast<size_t>(p.rank)] |=
        p.node == comm.node() && std::any_of(own.begin(), own.end(), [&](const Processor& mine) {
          return mine.number == p.number;
        });
  return static_cast<int>(std::count(shares.begin(), shares.end(), 1));
}

}  // namespace hrad
