// Ranks on several nodes, as threads of one process.
#pragma once

#include "support/thread_ranks.h"

namespace hrad_test {

class CommOnNodes final : public CommThreads {
 public:
  CommOnNodes(Hub& hub, int rank, int node) : CommThreads(hub, rank), node_(node) {}
  int node() const override { return node_; }

 private:
  const int node_;
};

}  // namespace hrad_test
