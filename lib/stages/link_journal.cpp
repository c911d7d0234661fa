// Recording and replaying. Floor 7 (stages).
#include "stages/link_journal.h"

#include <algorithm>
#include <numeric>

namespace hrad {
namespace {

int64_t bytes_of(const LinkStep& step) {
  return static_cast<int64_t>(step.counts.capacity() * sizeof step.counts[0] +
                              step.links.capacity() * sizeof step.links[0] +
                              step.values.capacity() * sizeof step.values[0]);
}

}  // namespace

void LinkStep::append(const LinkStep& more) {
  counts.insert(counts.end(), more.counts.begin(), more.counts.end());
  links.insert(links.end(), more.links.begin(), more.links.end());
  values.insert(values.end(), more.values.begin(), more.values.end());
  rays += more.rays;
}

void LinkJournal::begin(uint64_t key, int64_t rays) {
  if (key != key_) clear();
  key_ = key;
  rays_before = rays;
  next_ = 0;
}

const LinkStep* LinkJournal::done(size_t runs, bool with_values,
                                  const std::function<bool(NodeId)>& is_source) {
  if (next_ >= steps_.size()) return nullptr;
  const LinkStep& step = steps_[next_];
  const bool fits =
      step.counts.size() == runs && step.values.size() == (with_values ? runs : 0) &&
      std::accumulate(step.counts.begin(), step.counts.end(), size_t{0}) == step.links.size() &&
      std::all_of(step.links.begin(), step.links.end(),
                  [&](const Link& link) { return is_source(link.source); });
  if (fits) return &steps_[next_++];
  steps_.resize(next_);
  return nullptr;
}

void LinkJournal::record(LinkStep step) {
  if (!recording || next_ != steps_.size()) return;
  push(std::move(step));
  next_ = steps_.size();
}

void LinkJournal::push(LinkStep step) {
  bytes_ += bytes_of(step);
  steps_.push_back(std::move(step));
}

LinkJournal LinkJournal::restored(uint64_t key, int64_t rays_before, std::vector<LinkStep> steps) {
  LinkJournal journal;
  journal.key_ = key;
  journal.rays_before = rays_before;
  for (LinkStep& step : steps) journal.push(std::move(step));
  return journal;
}

}  // namespace hrad
