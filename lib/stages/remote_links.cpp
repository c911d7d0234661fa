// The assignment. Floor 7 (stages).
#include "stages/remote_links.h"

namespace hrad {

RemoteLinks::RemoteLinks(int owners, const std::vector<int32_t>& owner)
    : owners_(static_cast<size_t>(owners)), by_(owners_ * owners_) {
  // How many pairs face each other is not known before they are looked at: all of them count.
  std::vector<double> surfaces(owners_, 0), links;
  for (int32_t o : owner) surfaces[static_cast<size_t>(o)] += 1;
  for (size_t a = 0; a < owners_; ++a) {
    links.push_back(surfaces[a] * surfaces[a] / 2);
    by_[a * owners_ + a] = static_cast<int32_t>(a);
  }
  // By distance, so that all come to their turns evenly: of equal owners each gets as many. Owner by
  // owner the early ones would take little and the late ones nearly all of theirs.
  for (size_t step = 1; step <= owners_ / 2; ++step)
    for (size_t a = 0; a < owners_; ++a) {
      const size_t b = (a + step) % owners_;
      if (2 * step == owners_ && b < a) continue;  // it was met from the other side
      const size_t by = links[b] < links[a] ? b : a;
      links[by] += surfaces[a] * surfaces[b];
      by_[a * owners_ + b] = by_[b * owners_ + a] = static_cast<int32_t>(by);
    }
}

}  // namespace hrad
