// What a .hrad file holds, and its way into a file and out of one: a solution with its scene, its
// parameters and how far the solve has come. Nothing in it depends on threads, time or place.
// Floor 8 (solver).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/span.h"
#include "machine/comm.h"
#include "machine/shared_file.h"
#include "machine/thread_team.h"
#include "solver/measure.h"
#include "solver/params.h"
#include "solver/solve_progress.h"
#include "solver/stats.h"
#include "stages/state.h"
#include "visibility/inspection.h"

namespace hrad {

class AllPoints;
class Exchange;
class LightOfAll;

// What there is to be written. Nothing is copied.
struct CheckpointView {
  const Params& params;
  const Scene& scene;
  bool begun;                // a solve was: the result parameters hold
  const State* state;        // nullptr: nothing is linked
  const Exchange* exchange;  // where something is linked: whose the links are
  const AllPoints* points;   // likewise
  const LightOfAll *radiosity, *irradiance;
  Span<const LinkStep> steps;  // of linking or refinement that is under way: this process's own
  uint64_t key_of_steps;
  int64_t rays, pairs;
  const SolveProgress& progress;
  const Stats& stats;
  const PowerBalance& balance;
  const Inspection& inspection;
};

// Collective: each process gives its links and steps, and rank 0 what is not the same everywhere.
// team: to compress with, may be nullptr.
void write_checkpoint(Comm& comm, SharedFile& file, const CheckpointView& view, ThreadTeam* team);

// What was read. Every number is in its range, every index within what it indexes.
struct CheckpointContent {
  Params params;  // result parameters alone; the others are defaults
  Scene scene;
  bool begun = false;
  std::unique_ptr<State> state;  // on `scene`; none: nothing is linked
  SolveProgress progress;
  Stats stats;
  PowerBalance balance;
  Inspection inspection;
  int64_t rays = 0, pairs = 0;
  uint64_t key_of_steps = 0;
  std::vector<LinkStep> steps;  // of linking or refinement that was under way
  std::string origin;           // the library that wrote it, and its engine
  std::vector<std::pair<std::string, int64_t>> section_bytes;  // as stored
};

// FORMAT: bytes are not those of a checkpoint, with the section and the place. MEMORY: what they
// hold is over the limit (bytes, 0: none).
std::unique_ptr<CheckpointContent> read_checkpoint(const std::string& bytes, int64_t limit);

// The same from a file, with its name in messages; FILE when it can't be read.
std::unique_ptr<CheckpointContent> read_checkpoint_file(const std::string& path, int64_t limit);

// The same from the bytes that are in the file.
std::unique_ptr<CheckpointContent> read_checkpoint_bytes(const std::string& path,
                                                         const std::string& bytes, int64_t limit);

// What a file holds, as text for people: one `name: value` a line.
std::string describe_checkpoint(const std::string& path);

}  // namespace hrad
