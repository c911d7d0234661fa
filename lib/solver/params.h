// The one table of parameters: the C API, the CLI, its help and the manual all read it.
// Floor 8 (solver).
#pragma once

#include <cstdint>
#include <string>

#include "base/span.h"

namespace hrad {

struct Params {
  // Result parameters: they decide the bits.
  int64_t bands = 3;
  double accuracy = 0.02;
  std::string linking = "auto";   // pairs | clusters | rows | auto
  std::string detail = "points";  // points | means
  std::string oracle = "error";   // energy | error
  double bf_epsilon = 0;          // W; 0: from accuracy
  double min_area = 0;            // unit^2; 0: from accuracy and the scene
  double tolerance = 0;           // of a link, relative; 0: from accuracy
  int64_t max_iterations = 2000;  // sweeps
  int64_t refine = 1;             // 0: sweeps on the present links alone
  int64_t seed = 1;
  std::string unit = "m";
  std::string visibility = "builtin";  // builtin | embree
  std::string sides = "front";         // front | two-sided | flip
  // Run parameters: they never change a bit.
  int64_t threads = 0;                   // 0: from hwloc
  int64_t smt = 0;                       // 1: also use the cores' further contexts
  int64_t bind = 0;                      // 1: pin threads
  std::string partition = "cost";        // cost | grid
  int64_t max_memory = 0;                // bytes; 0: no limit
  int64_t resumable = 0;                 // 1: linking and refinement remember their steps
  int64_t checkpoint_keep = 1;           // older checkpoints kept beside a new one
  std::string up = "auto";               // auto | y | z
  std::string instruction_set = "auto";  // auto | sse2 | avx2 | avx512: forces the ray kernels
};

struct ParamRow {
  const char* name;
  int32_t type;  // 0 int, 1 double, 2 text
  bool is_result;
  double minimum, maximum;  // both included
  const char* choices;      // "a|b" or nullptr
  const char* unit;
  const char* help;
  int64_t Params::*as_int;
  double Params::*as_double;
  std::string Params::*as_text;
};

constexpr size_t longest_param_text = 4096;  // bytes

Span<const ParamRow> param_table();
const ParamRow& find_param(const std::string& name);  // ARGUMENT, with the nearest name as a hint
const char* default_text(const ParamRow& row);        // static lifetime

// Set one value after checking its type and range; ARGUMENT otherwise.
void set_param(Params& params, const ParamRow& row, int64_t value);
void set_param(Params& params, const ParamRow& row, double value);
void set_param(Params& params, const ParamRow& row, const std::string& value);  // parses any type
std::string param_text(const Params& params, const ParamRow& row);
bool same_value(const Params& a, const Params& b, const ParamRow& row);

}  // namespace hrad
