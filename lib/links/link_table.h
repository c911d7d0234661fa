// All links of a solution: the runs of their receivers side by side in flat arrays, cut into blocks
// of receivers, so that new links replace old ones block by block. Floor 6 (links).
#pragma once

#include <cstdint>
#include <vector>

#include "base/span.h"
#include "links/link.h"

namespace hrad {

class ThreadTeam;

// The links of one receiver.
class LinkRun {
 public:
  LinkRun(const Link* first, size_t count) : links_(first, count) {}
  Span<const Link> links() const { return links_; }
  int32_t count() const { return static_cast<int32_t>(links_.size()); }

 private:
  Span<const Link> links_;
};

class LinkTable {
 public:
  static constexpr size_t receivers_of_a_block = 1024;

  size_t size() const { return first_.size(); }
  LinkRun operator[](size_t receiver) const {
    const std::vector<Link>& block = blocks_[receiver / receivers_of_a_block];
    const size_t next = receiver + 1;
    const size_t end =
        next < first_.size() && next % receivers_of_a_block != 0 ? first_[next] : block.size();
    return {block.data() + first_[receiver], end - first_[receiver]};
  }
  // The runs of neighbouring receivers: of receiver + k the links from first[k] up to first[k + 1],
  // of the last one up to `end`.
  struct Block {
    size_t receiver, receivers;
    const Link* links;
    const uint32_t* first;
    uint32_t end;
  };
  size_t block_count() const { return blocks_.size(); }
  Block block(size_t number) const;

  int64_t link_count() const;
  // Of the arrays, and of that what the links take.
  int64_t bytes() const;
  int64_t bytes_of_links() const;

  // So many receivers; those behind the present ones have no links yet.
  void resize(size_t receivers);
  // One more receiver, with these links.
  void append(Span<const Link> links);
  // After the last append().
  void shrink_to_fit();
  // Gives these receivers new links, each at most once, in any order: block by block, on the
  // threads of a team if there is one.
  struct NewRun {
    NodeId receiver;
    Span<const Link> links;
  };
  void replace(std::vector<NewRun> runs, ThreadTeam* team = nullptr);

 private:
  void rebuild(size_t block, Span<const NewRun> runs);

  std::vector<uint32_t> first_;  // per receiver, within its block
  std::vector<std::vector<Link>> blocks_;
};

}  // namespace hrad
