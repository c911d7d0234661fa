// Ranks on several nodes, as threads of one process.
#pragma once

#include <thread>
#include <vector>

#include "support/thread_ranks.h"

namespace hrad_test {

class CommOnNodes final : public CommThreads {
 public:
  CommOnNodes(Hub& hub, int rank, int node) : CommThreads(hub, rank), node_(node) {}
  int node() const override { return node_; }

 private:
  const int node_;
};

// body(comm, rank) on a rank for each of these numbers, which name its node.
template <class Body>
void on_nodes(const std::vector<int>& nodes, const Body& body) {
  Hub hub(static_cast<int>(nodes.size()));
  std::vector<std::thread> threads;
  for (size_t rank = 0; rank < nodes.size(); ++rank)
    threads.emplace_back([&, rank] {
      CommOnNodes comm(hub, static_cast<int>(rank), nodes[rank]);
      body(comm, rank);
    });
  for (std::thread& thread : threads) thread.join();
}

// The nodes of places.
template <class Place>
std::vector<int> nodes_of(const std::vector<Place>& places) {
  std::vector<int> nodes;
  for (const Place& place : places) nodes.push_back(place.node);
  return nodes;
}

}  // namespace hrad_test
