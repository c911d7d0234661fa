// Foreign file formats of a solution: which ending names which format, and one writer for each. A
// file appears whole under its name or not at all. Floor 8 (solver).
#pragma once

#include <string>

namespace hrad {

class Solver;

// Writes the solution (.csv, .vtu) or the scene (.obj) in the format of the path's ending. ARGUMENT
// for an ending that names no format, UNSUPPORTED for .ply and .glb, STATE before a solve, FILE.
void export_solution(const Solver& solver, const std::string& path);

// One row per leaf, `patch,face,side,x0,...,z2,area,b0,b1,...`: corners, area and mean radiosity
// per band, every number in the shortest decimal form that reads back as the same double.
void export_csv(const Solver& solver, const std::string& path);

// VTK XML unstructured grid, version 1.0: one triangle with its own three points per leaf, so that
// both sides of a surface and steps between leaves keep their values.
void export_vtu(const Solver& solver, const std::string& path);

}  // namespace hrad
