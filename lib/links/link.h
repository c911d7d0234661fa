// Links: who sends light to whom. A link belongs to its receiver and names its source; its weight is
// form factor times visible fraction, from receiver to source, so that the irradiance it brings is
// weight times the source's radiosity. Floor 6 (links).
#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include "base/span.h"
#include "hierarchy/forest.h"

namespace hrad {

struct Link {
  NodeId source;
  float weight;
};
static_assert(sizeof(Link) == 8, "a link is eight bytes");

// The links of one receiver, an array of exactly their size.
class LinkRun {
 public:
  Span<const Link> links() const { return {data_.get(), static_cast<size_t>(count_)}; }
  int32_t count() const { return count_; }
  void assign(Span<const Link> links) {
    if (static_cast<size_t>(count_) != links.size()) {
      data_.reset(links.empty() ? nullptr : new Link[links.size()]);
      count_ = static_cast<int32_t>(links.size());
    }
    if (count_ > 0) std::memcpy(data_.get(), links.data(), links.size() * sizeof(Link));
  }

 private:
  std::unique_ptr<Link[]> data_;
  int32_t count_ = 0;
};

// Indexed by receiver.
using LinkTable = std::vector<LinkRun>;

}  // namespace hrad
