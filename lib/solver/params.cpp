// The table of parameters, the search for a name in it, and the strict reading of values: a whole
// token or nothing, whatever the locale. Floor 8 (solver).
#include "solver/params.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <vector>

#include "base/error.h"

namespace hrad {
namespace {

// The largest whole number up to which every one is a double, so that ranges print exactly.
constexpr double kLargestExact = 9007199254740992.0;  // 2^53

constexpr ParamRow int_row(const char* name, bool is_result, int64_t Params::*value, double minimum,
                           double maximum, const char* unit, const char* help) {
  return {name, 0, is_result, minimum, maximum, nullptr, unit, help, value, nullptr, nullptr};
}

constexpr ParamRow double_row(const char* name, bool is_result, double Params::*value,
                              double minimum, double maximum, const char* unit, const char* help) {
  return {name, 1, is_result, minimum, maximum, nullptr, unit, help, nullptr, value, nullptr};
}

constexpr ParamRow text_row(const char* name, bool is_result, std::string Params::*value,
                            const char* choices, const char* help) {
  return {name, 2, is_result, 0, 0, choices, "", help, nullptr, nullptr, value};
}

constexpr ParamRow kTable[] = {
    int_row("bands", true, &Params::bands, 1, 16, "",
            "Number of bands (colours, wavelengths) that are solved side by side; fixed by the "
            "first material."),
    double_row("accuracy", true, &Params::accuracy, 0.0005, 0.5, "",
               "Promised relative error (root of area-weighted mean square) of the patch means, "
               "all bands together, over the patches that do not emit."),
    text_row("linking", true, &Params::linking, "pairs|clusters|rows|auto",
             "Method of linking: pairs of patches as in the paper, clusters of patches where these "
             "are far from each other, rows of rays, or the one that suits the scene and the "
             "accuracy."),
    text_row("detail", true, &Params::detail, "points|means",
             "What is to be good: light at every point, for pictures and for queries at points, or "
             "the means of patches alone, by rows without a mesh of direct light, in less time and "
             "memory."),
    text_row("oracle", true, &Params::oracle, "energy|error",
             "What decides that a link is refined: the energy that it transports, or the estimate "
             "of its error."),
    double_row("bf_epsilon", true, &Params::bf_epsilon, 0, 1e30, "W",
               "Power over which a link is refined with oracle=energy; 0 derives it from the "
               "accuracy."),
    double_row("min_area", true, &Params::min_area, 0, 1e30, "unit^2",
               "Area under which an element is not subdivided; 0 derives it from the accuracy and "
               "the scene."),
    double_row("tolerance", true, &Params::tolerance, 0, 1, "",
               "Relative error that a link may have with oracle=error; 0 derives it from the "
               "accuracy."),
    int_row("max_iterations", true, &Params::max_iterations, 1, 1e9, "sweeps",
            "Sweeps after which a solve gives up and answers that it has not converged."),
    int_row("refine", true, &Params::refine, 0, 1, "",
            "1 refines the mesh and the links; 0 sweeps on the present links alone, for a new "
            "emission or reflectance."),
    int_row("seed", true, &Params::seed, 0, kLargestExact, "",
            "Number that all sample points are derived from; another seed gives an independent "
            "solution."),
    text_row("unit", true, &Params::unit, nullptr,
             "Name of the scene's unit of length; areas are in its square and nothing is "
             "converted."),
    text_row("visibility", true, &Params::visibility, "builtin|embree",
             "Ray engine that decides who sees whom."),
    text_row("sides", true, &Params::sides, "front|two-sided|flip",
             "How the windings of a loaded file are read: as they are, with every patch two-sided, "
             "or turned round."),
    int_row("threads", false, &Params::threads, 0, 4096, "threads",
            "Number of threads; 0 takes one per core that this process may use."),
    int_row("smt", false, &Params::smt, 0, 1, "",
            "1 also uses the further hardware threads of each core when threads is 0."),
    int_row("bind", false, &Params::bind, 0, 1, "", "1 binds each thread to its core."),
    text_row(
        "partition", false, &Params::partition, "cost|grid",
        "How patches are dealt out to ranks: halves of equal work, or the paper's uniform grid "
        "of boxes; one rank owns all."),
    int_row("max_memory", false, &Params::max_memory, 0, kLargestExact, "bytes",
            "Memory over which a solve stops with an error; 0 sets no limit."),
    int_row("resumable", false, &Params::resumable, 0, 1, "",
            "1 remembers what linking or a round of refinement has done so far, in memory, so that "
            "a stop and a checkpoint keep it."),
    int_row(
        "checkpoint_keep", false, &Params::checkpoint_keep, 0, 1000, "files",
        "How many older checkpoints stay beside a new one, as FILE.prev, FILE.prev2 and so on."),
    text_row("up", false, &Params::up, "auto|y|z",
             "Axis that points up, in pictures and .glb files; auto takes z with a built-in scene, "
             "with patches from arrays and with a file that says so, and stays for other files, "
             "which are taken to have y up unless their lamps tell otherwise."),
    text_row("instruction_set", false, &Params::instruction_set, "auto|sse2|avx2|avx512",
             "Instruction set of the builtin ray engine; every one gives the same bits."),
};
constexpr size_t kRows = sizeof kTable / sizeof kTable[0];

// Levenshtein's distance: insertions, deletions and replacements that turn a into b.
size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row[b.size()];
}

// Text for a message: what a user typed may be long or hold control characters.
std::string shown(const std::string& text) {
  constexpr size_t kLongest = 60;
  std::string result = text.substr(0, kLongest);
  for (char& c : result)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  return text.size() > kLongest ? result + "..." : result;
}

std::string number_text(int64_t value) { return std::to_string(value); }

// The shortest text that reads back as the same bits, without an exponent for ordinary magnitudes.
std::string number_text(double value) {
  const double magnitude = std::fabs(value);
  const bool ordinary = magnitude == 0 || (magnitude >= 1e-5 && magnitude <= kLargestExact);
  char text[64];
  const std::to_chars_result end =
      std::to_chars(text, text + sizeof text, value,
                    ordinary ? std::chars_format::fixed : std::chars_format::scientific);
  return std::string(text, end.ptr);
}

const char* type_text(const ParamRow& row) {
  return row.type == 0 ? "an integer" : row.type == 1 ? "a real number" : "text";
}

[[noreturn]] void fail_range(const ParamRow& row, const std::string& value) {
  fail(Status::argument, "parameter '%s' can't be %s: allowed is %s from %s to %s%s%s", row.name,
       value.c_str(), type_text(row), number_text(row.minimum).c_str(),
       number_text(row.maximum).c_str(), *row.unit ? " " : "", row.unit);
}

[[noreturn]] void fail_type(const ParamRow& row, const char* given) {
  fail(Status::argument, "parameter '%s' takes %s, not %s", row.name, type_text(row), given);
}

bool is_choice(const char* choices, const std::string& word) {
  for (const char* start = choices; start;) {
    const char* end = std::strchr(start, '|');
    const size_t size = end ? static_cast<size_t>(end - start) : std::strlen(start);
    if (word.size() == size && word.compare(0, size, start, size) == 0) return true;
    start = end ? end + 1 : nullptr;
  }
  return false;
}

// Reads the whole text as one number; std::from_chars knows no locale, spaces or plus signs.
template <class Number>
bool parse(const std::string& text, Number* value) {
  const char* end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, *value);
  return result.ec == std::errc() && result.ptr == end;
}

}  // namespace

Span<const ParamRow> param_table() { return Span<const ParamRow>(kTable, kRows); }

const ParamRow& find_param(const std::string& name) {
  const ParamRow* nearest = nullptr;
  // Further away than this, a hint would be a guess.
  size_t nearest_distance = 3;
  // A name cut to a little over the longest in the table is as far away as the whole.
  const std::string start = name.substr(0, 32);
  for (const ParamRow& row : param_table()) {
    if (name == row.name) return row;
    const size_t distance = edit_distance(start, row.name);
    if (distance < nearest_distance || (distance == nearest_distance && !nearest)) {
      nearest = &row;
      nearest_distance = distance;
    }
  }
  if (nearest && nearest_distance < std::strlen(nearest->name))
    fail(Status::argument, "there is no parameter '%s': did you mean '%s'?", shown(name).c_str(),
         nearest->name);
  std::string names;
  for (const ParamRow& row : param_table())
    names += std::string(names.empty() ? "" : ", ") + row.name;
  fail(Status::argument, "there is no parameter '%s': the parameters are %s", shown(name).c_str(),
       names.c_str());
}

const char* default_text(const ParamRow& row) {
  // Made once from the defaults in Params, and kept for ever: callers hold the pointers.
  static const std::vector<std::string>& texts = *[] {
    auto* made = new std::vector<std::string>;
    for (const ParamRow& each : param_table()) made->push_back(param_text(Params(), each));
    return made;
  }();
  return texts[static_cast<size_t>(&row - kTable)].c_str();
}

void set_param(Params& params, const ParamRow& row, int64_t value) {
  if (row.type != 0) fail_type(row, "an integer");
  // The bounds are whole numbers within +-2^53, so they convert exactly.
  if (value < static_cast<int64_t>(row.minimum) || value > static_cast<int64_t>(row.maximum))
    fail_range(row, number_text(value));
  params.*row.as_int = value;
}

void set_param(Params& params, const ParamRow& row, double value) {
  if (row.type != 1) fail_type(row, "a real number");
  // Written so that a value that is not a number fails.
  if (!(value >= row.minimum && value <= row.maximum)) fail_range(row, number_text(value));
  params.*row.as_double = value == 0 ? 0 : value;  // -0 and +0 are one value
}

void set_param(Params& params, const ParamRow& row, const std::string& value) {
  if (row.type == 0) {
    int64_t number = 0;
    if (!parse(value, &number)) fail_range(row, "'" + shown(value) + "'");
    set_param(params, row, number);
  } else if (row.type == 1) {
    double number = 0;
    if (!parse(value, &number)) fail_range(row, "'" + shown(value) + "'");
    set_param(params, row, number);
  } else {
    if (row.choices && !is_choice(row.choices, value))
      fail(Status::argument, "parameter '%s' can't be '%s': allowed is %s", row.name,
           shown(value).c_str(), row.choices);
    if (value.size() > longest_param_text)
      fail(Status::argument, "parameter '%s' has %zu bytes: %zu are allowed", row.name,
           value.size(), longest_param_text);
    params.*row.as_text = value;
  }
}

std::string param_text(const Params& params, const ParamRow& row) {
  if (row.type == 0) return number_text(params.*row.as_int);
  if (row.type == 1) return number_text(params.*row.as_double);
  return params.*row.as_text;
}

bool same_value(const Params& a, const Params& b, const ParamRow& row) {
  if (row.type == 0) return a.*row.as_int == b.*row.as_int;
  if (row.type == 1) return a.*row.as_double == b.*row.as_double;
  return a.*row.as_text == b.*row.as_text;
}

}  // namespace hrad
