// The Linking Stage by rows (design: `rows`): light straight from bright emitters on an adaptive
// mesh of its own, everything else by rays from cells that are fine where reflected light varies,
// and from what is far brighter than all else. There is nothing to refine afterwards. Floor 7
// (stages).
#pragma once

#include "stages/state.h"

namespace hrad {

struct RowSettings {
  // Of the elements that own rows: at the most, and at the least.
  double cell_area = 1, least_cell_area = 0;
  // Contrast of reflected light (cell_contrast.h) over which a cell is divided, weighted with the
  // root of its area over cell_area; as all that follows in units of the scene's mean irradiance.
  double contrast = 0.03;
  // Of a cell of cell_area; smaller ones have fewer, by the root of the area.
  int rays_of_cell = 64;
  int least_rays = 16;
  // Deviation of direct light from linear that is tolerated between corners, weighted likewise.
  double tolerance = 0.1;
  double min_area = 0;  // of elements
  // Direct light is the mean over each cell, known at no points, and has no mesh of its own.
  bool means_only = false;
  double least_bright = 0.01;  // Emitters'
  double shadow_noise = 0.1;   // DirectLight's, at points
  double grid_size = 1;        // LightGrid's
  uint64_t seed = 1;

  // Of the row of a cell of this area, before it is known what it sees.
  int rays_of(double area) const;
  // What a ray from a bright spot (bright_spots.h) brings to a cell of cell_area, in units of the
  // mean irradiance: as many as make that up deviate like the row of the cell.
  double power_of_spot_rays() const;
};

// Makes mesh, rows and direct light from a state of roots alone whose exposure is known; leaves
// B = E. False: stopped by tools.progress, and of no use then until it is cleared; but what is in
// the journal spares the next call these steps.
bool link_rows(State& state, const StageTools& tools, const RowSettings& settings);

}  // namespace hrad
