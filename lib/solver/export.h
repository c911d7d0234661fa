// Foreign file formats of a solution: which ending names which format, and one writer for each. A
// file appears whole under its name or not at all. Floor 8 (solver).
#pragma once

#include <cstdint>
#include <string>

namespace hrad {

class Solver;
struct PartitionPlan;
struct Scene;

// Writes the solution (.csv, .vtu, .ply, .glb) or the scene (.obj) in the format of the path's
// ending. ARGUMENT for an ending that names no format, STATE before a solve, FILE, UNSUPPORTED for
// a solution larger than the format can hold.
void export_solution(const Solver& solver, const std::string& path);
// Whether the format of this path shows a solution, and not the scene alone.
bool needs_solution(const std::string& path);

// One row per leaf, `patch,face,side,x0,...,z2,area,b0,b1,...`: corners, area and mean radiosity
// per band, every number in the shortest decimal form that reads back as the same double.
void export_csv(const Solver& solver, const std::string& path);

// VTK XML unstructured grid, version 1.0: one triangle with its own three points per leaf, so that
// both sides of a surface and steps between leaves keep their values.
void export_vtu(const Solver& solver, const std::string& path);

// The patches with their owners, and the work that was predicted for each, likewise. ARGUMENT
// unless the path ends in .vtu.
void check_partition_file(const std::string& path);  // ARGUMENT for another ending
void export_partition(const Scene& scene, const PartitionPlan& plan, const std::string& path);

// Polygon file, binary little-endian: a mesh with shared vertices; positions as doubles, linear
// radiosity per band as floats, sRGB colours for display.
void export_ply(const Solver& solver, const std::string& path);

// glTF 2.0 in one binary file: the same mesh with single-precision positions, normals, linear
// radiosity and linear colours for display, unlit.
void export_glb(const Solver& solver, const std::string& path);

// The length of a .glb file of which this much is JSON. UNSUPPORTED, naming the path, from 4 GiB
// on.
uint32_t glb_length(const std::string& path, uint64_t json_bytes, uint64_t binary_bytes);

}  // namespace hrad
