// All links of a solution: the runs of their receivers side by side in flat arrays, cut into blocks
// of receivers, so that new links replace old ones block by block. Floor 6 (links).
#pragma once

#include <cstdint>
#include <vector>

#include "base/presence.h"
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
  static constexpr int64_t most_bytes_of_a_receiver = 5;  // beside its links

  size_t size() const { return size_; }
  LinkRun operator[](size_t receiver) const {
    const Block& block = blocks_[receiver / receivers_of_a_block];
    const size_t k = receiver % receivers_of_a_block;
    if (!block.has_links[k]) return {nullptr, 0};
    const size_t run = block.has_links.place(k), first = run > 0 ? block.ends[run - 1] : 0;
    return {block.links.data() + first, block.ends[run] - first};
  }
  // The runs of neighbouring receivers, of which many have none.
  struct Block {
    Presence has_links;
    std::vector<uint32_t> ends;  // of each run, from the end of the one before
    std::vector<Link> links;
  };
  size_t block_count() const { return blocks_.size(); }
  const Block& block(size_t number) const { return blocks_[number]; }
  // For whoever gives sources other names and these back.
  std::vector<Link>& links_of_block(size_t number) { return blocks_[number].links; }

  int64_t link_count() const;
  // Of the arrays, and of that what the links take.
  int64_t bytes() const;
  int64_t bytes_of_links() const;

  // So many receivers: new ones have no links yet, and those behind are dropped with theirs.
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
  static void append(Span<const Link> links, Block& block);
  static void shrink_to_fit(Block& block);
  void rebuild(size_t block, Span<const NewRun> runs);

  size_t size_ = 0;
  std::vector<Block> blocks_;
};

}  // namespace hrad
