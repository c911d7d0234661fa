// Steps of a stage that is under way, as runs of a checkpoint and back. Floor 8 (solver).
#include <limits>

#include "solver/checkpoint_sizes.h"

namespace hrad {

void pack_step(const LinkStep& step, PackedBytes& bytes) {
  bytes.varint(step.pass);
  bytes.varint(step.names.size());
  uint64_t before = 0;
  for (uint64_t name : step.names) {
    bytes.signed_varint(static_cast<int64_t>(name - before));
    before = name;
  }
  before = 0;
  for (uint64_t end : step.ends) {
    bytes.varint(end - before);
    before = end;
  }
  bytes.raw(std::string(step.results.begin(), step.results.end()));
}

LinkStep unpack_step(PackedReader& bytes) {
  constexpr int64_t most = std::numeric_limits<uint32_t>::max();
  LinkStep step;
  step.pass = static_cast<uint32_t>(bytes.count("the pass of a step", 0, most));
  const auto left = [&] { return static_cast<int64_t>(bytes.left()); };
  const int64_t tasks = bytes.count("the number of a step's tasks", 0, left());
  uint64_t name = 0;
  for (int64_t k = 0; k < tasks; ++k) {
    name += static_cast<uint64_t>(bytes.signed_varint());
    step.names.push_back(name);
  }
  int64_t end = 0;
  for (int64_t k = 0; k < tasks; ++k) {
    end += bytes.count("the bytes of a task's result", 0, left() - end);
    step.ends.push_back(static_cast<uint64_t>(end));
  }
  const std::string results = bytes.raw(static_cast<size_t>(end));
  step.results.assign(results.begin(), results.end());
  return step;
}

}  // namespace hrad
