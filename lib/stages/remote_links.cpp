// The assignment. Floor 7 (stages).
#include "stages/remote_links.h"

#include <algorithm>

namespace hrad {

RemoteLinks::RemoteLinks(int owners, const std::vector<uint64_t>& pairs)
    : owners_(static_cast<size_t>(owners)), by_(owners_ * owners_) {
  struct Between {
    size_t a, b;
    uint64_t links;
  };
  std::vector<uint64_t> links;
  std::vector<Between> remote;
  for (size_t a = 0; a < owners_; ++a) {
    links.push_back(pairs[a * owners_ + a]);
    by_[a * owners_ + a] = static_cast<int32_t>(a);
    for (size_t b = a + 1; b < owners_; ++b)
      remote.push_back({a, b, pairs[a * owners_ + b] + pairs[b * owners_ + a]});
  }
  std::stable_sort(remote.begin(), remote.end(),
                   [](const Between& x, const Between& y) { return x.links > y.links; });
  for (const Between& r : remote) {
    const size_t by = links[r.b] < links[r.a] ? r.b : r.a;
    links[by] += r.links;
    by_[r.a * owners_ + r.b] = by_[r.b * owners_ + r.a] = static_cast<int32_t>(by);
  }
}

}  // namespace hrad
