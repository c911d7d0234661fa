// The order of the steps: mesh by direct light, cells by pilot rows, final rows. Floor 7 (stages).
#include "stages/rows.h"

#include "base/hash.h"
#include "stages/gather.h"
#include "stages/row_mesh.h"
#include "stages/row_tracer.h"
#include "stages/sweep.h"

namespace hrad {
namespace {

constexpr int pilot_rounds = 4;
// Pilot rows tell where light varies, not how much there is.
constexpr int pilot_share = 2;
// Bounces after which it is known well enough where that is.
constexpr int pilot_sweeps = 6;

// The part of the whole from `from` to `to`.
StageTools part_of(const StageTools& tools, double from, double to) {
  StageTools part = tools;
  part.progress = [&tools, from, to](double fraction) {
    return tools.progress(from + (to - from) * fraction);
  };
  return part;
}

Brightness light_of_pilot_rows(State& state, ThreadTeam& team) {
  reset_to_emission(state);
  for (int k = 0; k < pilot_sweeps; ++k) {
    gather(state, team);
    push_pull(state, team);
  }
  return measure_brightness(state, team);
}

}  // namespace

bool link_rows(State& state, const StageTools& tools, const RowSettings& settings) {
  const Brightness expected = expected_brightness(state);
  const Emitters emitters(state.forest, expected.of_node, settings.least_bright);
  LightGrid grid(emitters, tools.engine, settings.grid_size);
  const DirectLight light(state.forest, tools.engine, emitters, grid, settings.shadow_noise);
  StageMemory memory(state);
  RowMesh mesh(state, part_of(tools, 0, 0.3), settings, light, grid, expected, memory);
  if (!mesh.build()) return false;
  pull_exposure(state.forest);

  // The rows that cells are divided by aren't kept: those that chance made bright would be traced
  // anew and those that it made dark would stay.
  RowSettings pilot = settings;
  pilot.rays_of_cell = settings.rays_of_cell / pilot_share;
  pilot.seed = mix(settings.seed, 0x70696c6f74u);
  std::vector<NodeId> cells = state.cells;
  for (int round = 0; round < pilot_rounds && !cells.empty(); ++round) {
    const double from = 0.3 + 0.3 * round / pilot_rounds;
    if (!trace_rows(state, part_of(tools, from, from + 0.3 / pilot_rounds), pilot, emitters, cells,
                    memory))
      return false;
    if (!mesh.divide_cells(light_of_pilot_rows(state, tools.team), cells)) return false;
    pull_exposure(state.forest);
  }
  if (!trace_rows(state, part_of(tools, 0.6, 1), settings, emitters, state.cells, memory))
    return false;
  reset_to_emission(state);
  memory.settle();
  return true;
}

}  // namespace hrad
