// Steps of linking that is under way, as runs of a checkpoint and back. Floor 8 (solver).
#include <cmath>
#include <limits>

#include "solver/checkpoint_runs.h"
#include "solver/checkpoint_sizes.h"

namespace hrad {

void pack_step(const LinkStep& step, PackedBytes& bytes) {
  std::vector<size_t> first(1, 0);
  for (uint32_t count : step.counts) first.push_back(first.back() + count);
  bytes.varint(static_cast<uint64_t>(step.rays));
  bytes.varint(step.counts.size());
  bytes.byte(!step.values.empty());
  std::vector<uint32_t> values;
  for (float value : step.values) values.push_back(bits_of(value));
  bytes.planes(values);
  const auto run_of = [&](int64_t k) {
    const auto run = static_cast<size_t>(k);
    return Span<const Link>(step.links.data() + first[run], step.counts[run]);
  };
  pack_runs(0, static_cast<int64_t>(step.counts.size()), run_of, bytes);
}

LinkStep unpack_step(PackedReader& bytes) {
  constexpr int64_t most = std::numeric_limits<int64_t>::max();
  constexpr NodeId most_nodes = std::numeric_limits<NodeId>::max();
  LinkStep step;
  step.rays = bytes.count("the number of a step's rays", 0, most);
  const int64_t runs =
      bytes.count("the number of a step's runs", 0, static_cast<int64_t>(bytes.left()));
  std::vector<uint32_t> values;
  if (bytes.flag("whether a step has values")) bytes.planes(static_cast<size_t>(runs), values);
  for (uint32_t bits : values) {
    if (!std::isfinite(float_of(bits)))
      fail_format(bytes.place(), "a value of a step is %g", static_cast<double>(float_of(bits)));
    step.values.push_back(float_of(bits));
  }
  // Nodes are not known yet: linking looks at every source before it takes it.
  int64_t left = most;
  unpack_runs(0, runs, most_nodes, left, bytes, [&](Span<const Link> run) {
    step.counts.push_back(static_cast<uint32_t>(run.size()));
    step.links.insert(step.links.end(), run.begin(), run.end());
  });
  return step;
}

}  // namespace hrad
