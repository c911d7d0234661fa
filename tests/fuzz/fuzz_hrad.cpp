// Fuzz target: any bytes as a .hrad file, as they are or, where they don't begin as one, as the
// plain contents of its sections (a byte with the number of runs, four bytes with its length before
// each), which are put into a file with right checksums. Reading ends with a typed error that names
// the section, or with a state that can be swept and drawn, and with a solve that can go on.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/error.h"
#include "fuzz/target.h"
#include "solver/checkpoint.h"
#include "solver/reconstruction.h"
#include "solver/solver.h"
#include "stages/gather.h"
#include "stages/sweep.h"
#include "support/alone.h"
#include "support/checkpoint_frame.h"

namespace {

std::string file_of_sections(const std::string& bytes) {
  hrad_test::Frame frame(hrad::section_count);
  size_t at = 0;
  for (auto& runs : frame) {
    const int count = at < bytes.size() ? static_cast<unsigned char>(bytes[at++]) : 0;
    for (int k = 0; k < count && at + 4 <= bytes.size(); ++k) {
      const size_t size = hrad_test::little_endian(bytes, at, 4) % (size_t{1} << 20);
      at += 4;
      hrad_test::FrameRun run;
      run.raw = bytes.substr(std::min(at, bytes.size()), size);
      runs.push_back(run);
      at += size;
    }
  }
  return hrad_test::file_of(frame);
}

void use(hrad::CheckpointContent& content) {
  if (!content.state || content.state->forest.surface_count() == 0) return;
  hrad::State& state = *content.state;
  hrad::ThreadTeam team(1);
  const auto leaves = state.forest.leaves();
  std::vector<double> light(3 * static_cast<size_t>(state.bands));
  hrad_test::Alone alone(state);
  const hrad::Reconstruction linear(state, leaves, alone.exchange, team, 1);
  for (hrad::NodeId leaf : leaves) linear.corners(leaf, light.data());
  hrad::gather(state, team);
  hrad::push_pull(state, team, alone.exchange);
}

// What a solve does with it within some hundred calls of its progress function; of small scenes and
// ordinary thresholds alone, which take milliseconds.
void go_on(const std::string& file, const hrad::CheckpointContent& content) {
  const hrad::Params& params = content.params;
  if (content.scene.patch_count() > 40 || params.accuracy < 0.2 || params.tolerance > 0 ||
      params.bf_epsilon > 0 || params.min_area > 0 || params.visibility != "builtin")
    return;
  const int memory = ::memfd_create("hrad", MFD_CLOEXEC);
  if (memory < 0) return;
  const auto written = ::write(memory, file.data(), file.size());
  hrad::Solver solver;
  try {
    if (written == static_cast<ssize_t>(file.size())) {
      solver.set_int("threads", 1);
      solver.set_int("max_memory", int64_t{1} << 26);
      solver.read_checkpoint("/proc/self/fd/" + std::to_string(memory));
      int calls = 0;
      solver.set_progress([&](const hrad::Progress&) { return ++calls < 300; });
      solver.solve();
    }
  } catch (const hrad::Error&) {
  }
  ::close(memory);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const bool whole = bytes.compare(0, 4, "\x89HRD") == 0;
  try {
    constexpr int64_t limit = int64_t{1} << 28;
    const std::string file = whole ? bytes : file_of_sections(bytes);
    const auto content = hrad::read_checkpoint(file, limit);
    use(*content);
    go_on(file, *content);
  } catch (const hrad::Error& error) {
    const bool typed = error.status() == hrad::Status::memory ||
                       (error.status() == hrad::Status::format &&
                        std::string(error.what()).find("section '") != std::string::npos);
    if (!typed) std::abort();
  }
  return 0;
}
