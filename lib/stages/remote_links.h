// Who computes the links between surfaces of two owners: a pair of links, in both directions, is
// computed once, by one of the two, and told to the other (paper, Section 3.2). Floor 7 (stages).
#pragma once

#include <cstdint>
#include <vector>

#include "links/link.h"
#include "machine/comm.h"

namespace hrad {

class RemoteLinks {
 public:
  // All links between two owners are assigned to the one with fewer so far. pairs:
  // of surfaces that face each other, counted for owners a and b at a * owners + b or the other way
  // round.
  RemoteLinks(int owners, const std::vector<uint64_t>& pairs);

  // Whoever computes the links between surfaces of these two, which may be the same.
  int32_t computed_by(int32_t a, int32_t b) const { return by_[a * owners_ + b]; }

 private:
  size_t owners_;
  std::vector<int32_t> by_;
};

// A link found by somebody else than the owner of its receiver.
struct FoundLink {
  NodeId receiver;
  Link link;
};

}  // namespace hrad
