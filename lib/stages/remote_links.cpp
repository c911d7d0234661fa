// The assignment. Floor 7 (stages).
#include "stages/remote_links.h"

namespace hrad {

RemoteLinks::RemoteLinks(int owners, const std::vector<uint64_t>& pairs)
    : owners_(static_cast<size_t>(owners)), by_(owners_ * owners_) {
  struct Between {
    size_t a, b;
    uint64_t links;
    size_t by;
  };
  std::vector<uint64_t> links;
  for (size_t a = 0; a < owners_; ++a) links.push_back(pairs[a * owners_ + a]);
  // By distance, so that all come to their turns evenly: of equal owners each gets as many. Owner
  // by owner the early ones would take little and the late ones nearly all of theirs.
  std::vector<Between> remote;
  for (size_t step = 1; step <= owners_ / 2; ++step)
    for (size_t a = 0; a < owners_; ++a) {
      const size_t b = (a + step) % owners_;
      if (2 * step == owners_ && b < a) continue;  // it was met from the other side
      const uint64_t both = pairs[a * owners_ + b] + pairs[b * owners_ + a];
      const size_t by = links[b] < links[a] ? b : a;
      links[by] += both;
      remote.push_back({a, b, both, by});
    }
  // What came early was dealt out before it was known what would follow: as long as that evens the
  // two ends out, they swap.
  bool any = true;
  for (size_t round = 0; any && round < owners_; ++round) {
    any = false;
    for (Between& r : remote) {
      const size_t other = r.a + r.b - r.by;
      if (!(links[r.by] > links[other] + r.links)) continue;
      links[r.by] -= r.links;
      links[other] += r.links;
      r.by = other;
      any = any || r.links > 0;
    }
  }
  for (size_t a = 0; a < owners_; ++a) by_[a * owners_ + a] = static_cast<int32_t>(a);
  for (const Between& r : remote)
    by_[r.a * owners_ + r.b] = by_[r.b * owners_ + r.a] = static_cast<int32_t>(r.by);
}

}  // namespace hrad
