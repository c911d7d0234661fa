// hrad info. CLI: public headers only.
#include <algorithm>
#include <cmath>

#include "command.h"
#include "exit_code.h"
#include "json.h"
#include "numbers.h"
#include "run_options.h"
#include "scene_report.h"
#include "session.h"
#include "solve_report.h"
#include "text_table.h"

namespace hrad::cli {
namespace {

constexpr int digits = 6;

std::string join(const double* values, size_t count) {
  std::string text;
  for (size_t i = 0; i < count; ++i) text += (i > 0 ? " " : "") + short_text(values[i], digits);
  return text;
}

std::string join(const std::vector<double>& values) { return join(values.data(), values.size()); }

std::string flags_text(int32_t flags) {
  if (flags & HRAD_BLOCKER) return "blocker";
  return flags & HRAD_TWO_SIDED ? "two-sided" : "";
}

struct ParameterValue {
  hrad_param row;
  std::string value;
  bool is_default;
};

std::vector<ParameterValue> parameter_values(const Session& session) {
  std::vector<ParameterValue> result;
  for (const hrad_param& row : parameter_table()) {
    const std::string value = session.parameter(row.name);
    result.push_back({row, value, value == row.default_text});
  }
  return result;
}

// What is known of a solution in a file besides its scene.
struct SolutionReport {
  std::vector<std::pair<std::string, std::string>> description;  // of the library
  bool is_solved = false, is_measured = false;
  std::string hash;
  std::vector<double> emitted, absorbed, absorbed_back, escaped;  // W per band
  hrad_stats stats{};
};

SolutionReport make_solution_report(Session* session, const std::string& path) {
  SolutionReport report;
  const std::string text = fetch_text([&](char* to, int64_t size, int64_t* needed) {
    return hrad_describe_checkpoint(path.c_str(), to, size, needed);
  });
  for (std::string_view line : split(text, '\n')) {
    const size_t colon = line.find(": ");
    if (colon != std::string_view::npos)
      report.description.emplace_back(line.substr(0, colon), line.substr(colon + 2));
  }
  report.stats = session->stats();
  int64_t leaves = 0;
  report.is_solved = hrad_leaf_count(session->solver(), &leaves) == HRAD_OK;
  if (!report.is_solved) return report;
  report.hash = hash_text(session->solver());
  const auto bands = static_cast<size_t>(session->bands());
  for (auto* power : {&report.emitted, &report.absorbed, &report.absorbed_back, &report.escaped})
    power->resize(bands);
  const hrad_status status =
      hrad_power_balance(session->solver(), report.emitted.data(), report.absorbed.data(),
                         report.absorbed_back.data(), report.escaped.data());
  // Of a solve that was stopped, or of a light that was followed by another.
  report.is_measured = status != HRAD_ERROR_STATE;
  if (report.is_measured) check(status);
  return report;
}

void append_solution(std::string* text, const SolutionReport& report) {
  TextTable table("ll");
  for (const auto& [name, value] : report.description) table.add_row({name, value});
  if (report.is_solved) {
    table.add_row({"state hash", report.hash});
    table.add_row({"error estimate",
                   report.stats.error_estimate < 0
                       ? "not measured"
                       : short_text(100 * report.stats.error_estimate, 3) + " % +- " +
                             short_text(100 * report.stats.error_standard_error, 3) + " %"});
    const auto power = [&](const std::vector<double>& bands) {
      return report.is_measured ? join(bands) + " W" : "not measured";
    };
    table.add_row({"power emitted", power(report.emitted)});
    table.add_row({"absorbed", power(report.absorbed)});
    table.add_row({"absorbed by backs", power(report.absorbed_back)});
    table.add_row({"escaped", power(report.escaped)});
  }
  *text += "\n" + table.text();
}

void append_solution(JsonWriter* json, const SolutionReport& report) {
  json->begin_object("solution");
  for (auto [name, value] : report.description) {
    std::replace(name.begin(), name.end(), ' ', '_');
    int64_t number = 0;
    if (read_integer(value, &number))
      json->field(name.c_str(), number);
    else
      json->field(name.c_str(), value);
  }
  if (report.is_solved) {
    const auto bands = static_cast<int64_t>(report.emitted.size());
    json->field("state_hash", report.hash);
    const bool measured = report.stats.error_estimate >= 0;
    json->field("error_estimate", measured ? report.stats.error_estimate : NAN);
    if (report.is_measured) {
      json->field("emitted", report.emitted.data(), bands);
      json->field("absorbed", report.absorbed.data(), bands);
      json->field("absorbed_back", report.absorbed_back.data(), bands);
      json->field("escaped", report.escaped.data(), bands);
    }
  }
  json->end();
}

using AppendReport = void(std::string* text, const std::string& scene, const SceneReport& report,
                          const std::vector<ParameterValue>& parameters,
                          const SolutionReport* solution);

void append_text(std::string* text, const std::string& scene, const SceneReport& report,
                 const std::vector<ParameterValue>& parameters, const SolutionReport* solution) {
  TextTable sizes("ll");
  const std::string& unit = report.unit;
  sizes.add_row({"scene", scene});
  sizes.add_row({"patches", std::to_string(report.patches)});
  sizes.add_row({"dropped", std::to_string(report.dropped)});
  sizes.add_row({"two-sided", std::to_string(report.two_sided)});
  sizes.add_row({"blockers", std::to_string(report.blockers)});
  sizes.add_row({"emitters", std::to_string(report.emitters)});
  sizes.add_row({"from", join(report.lower, 3) + " " + unit});
  sizes.add_row({"to", join(report.upper, 3) + " " + unit});
  sizes.add_row({"area", short_text(report.area, digits) + " " + unit + "^2"});
  sizes.add_row({"emitted", join(report.power) + " W"});
  *text += sizes.text();

  TextTable materials("rlllrr");
  materials.add_row({"", "MATERIAL", "REFLECTANCE", "EMISSION", "PATCHES", "AREA", "FLAGS"});
  for (size_t i = 0; i < report.materials.size(); ++i) {
    const MaterialReport& material = report.materials[i];
    materials.add_row({std::to_string(i), cell_text(material.name), join(material.reflectance),
                       join(material.emission), std::to_string(material.patches),
                       short_text(material.area, digits), flags_text(material.flags)});
  }
  *text += "\n" + materials.text();
  if (report.own_emission > 0)
    *text += std::to_string(report.own_emission) + " patches have an emission of their own\n";

  TextTable table("lll");
  table.add_row({"", "PARAMETER", "VALUE"});
  for (const ParameterValue& parameter : parameters)
    table.add_row(
        {parameter.is_default ? "" : "*", parameter.row.name,
         parameter.value + (parameter.is_default
                                ? ""
                                : std::string(" (default ") + parameter.row.default_text + ")")});
  *text += "\n" + table.text();

  if (solution != nullptr) append_solution(text, *solution);
  *text += report.diagnostics.empty() ? "\nnothing doubtful was found\n" : "\n";
  for (const std::string& diagnostic : report.diagnostics)
    *text += "doubtful: " + diagnostic + "\n";
}

void append_materials(JsonWriter* json, const std::vector<MaterialReport>& materials) {
  json->begin_array("materials");
  for (const MaterialReport& material : materials) {
    const auto bands = static_cast<int64_t>(material.reflectance.size());
    json->begin_object();
    json->field("name", material.name);
    json->field("reflectance", material.reflectance.data(), bands);
    json->field("emission", material.emission.data(), bands);
    json->field("two_sided", (material.flags & HRAD_TWO_SIDED) != 0);
    json->field("blocker", (material.flags & HRAD_BLOCKER) != 0);
    json->field("patches", material.patches);
    json->field("area", material.area);
    json->end();
  }
  json->end();
}

void append_json(std::string* text, const std::string& scene, const SceneReport& report,
                 const std::vector<ParameterValue>& parameters, const SolutionReport* solution) {
  JsonWriter json(text);
  json.begin_object();
  json.field("version", hrad_version_text());
  json.field("scene", scene);
  json.field("patches", report.patches);
  json.field("dropped", report.dropped);
  json.field("two_sided", report.two_sided);
  json.field("blockers", report.blockers);
  json.field("emitters", report.emitters);
  json.field("own_emission", report.own_emission);
  json.field("unit", report.unit);
  json.field("lower", report.lower, 3);
  json.field("upper", report.upper, 3);
  json.field("area", report.area);
  json.field("emitted", report.power.data(), static_cast<int64_t>(report.power.size()));
  append_materials(&json, report.materials);
  json.begin_array("parameters");
  for (const ParameterValue& parameter : parameters) {
    json.begin_object(JsonWriter::one_line);
    json.field("name", parameter.row.name);
    json.field("value", parameter.value);
    json.field("is_default", parameter.is_default);
    json.end();
  }
  json.end();
  if (solution != nullptr) append_solution(&json, *solution);
  json.begin_array("diagnostics");
  for (const std::string& diagnostic : report.diagnostics) json.value(diagnostic);
  json.end();
  json.end();
}

}  // namespace

int run_info(const std::vector<std::string>& arguments, Output* output) {
  RunOptions options;
  bool as_json = false;
  Arguments parser("info",
                   "Print what is in a scene and what is doubtful in it, without solving it.",
                   "Areas count one side of each patch; a * marks parameters that differ from "
                   "their default. Of a .hrad file, also its solution is described.\n\n"
                   "Example: hrad info room.obj --json");
  options.add_to(&parser, "info", RunOptions::a_scene);
  parser.add_flag("--json", &as_json, "Print one JSON object");
  if (!parser.parse(arguments, &output->text())) return 0;
  if (!options.check()) return exit_done;

  Session session(options);
  session.load();
  const std::string obstacle = session.inspect();
  SceneReport report = make_scene_report(&session);
  if (!obstacle.empty()) report.diagnostics.push_back("can't be solved: " + obstacle);
  SolutionReport solution;
  const bool is_solution = options.scene_is_checkpoint();
  if (is_solution) solution = make_solution_report(&session, options.scene());
  const auto append = as_json ? static_cast<AppendReport*>(append_json) : append_text;
  append(&output->text(), options.scene(), report, parameter_values(session),
         is_solution ? &solution : nullptr);
  return 0;
}

}  // namespace hrad::cli
