// hrad info. CLI: public headers only.
#include "command.h"
#include "json.h"
#include "numbers.h"
#include "run_options.h"
#include "scene_report.h"
#include "session.h"
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

void append_text(std::string* text, const std::string& scene, const SceneReport& report,
                 const std::vector<ParameterValue>& parameters) {
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

  TextTable table("lll");
  table.add_row({"", "PARAMETER", "VALUE"});
  for (const ParameterValue& parameter : parameters)
    table.add_row(
        {parameter.is_default ? "" : "*", parameter.row.name,
         parameter.value + (parameter.is_default
                                ? ""
                                : std::string(" (default ") + parameter.row.default_text + ")")});
  *text += "\n" + table.text();

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
                 const std::vector<ParameterValue>& parameters) {
  JsonWriter json(text);
  json.begin_object();
  json.field("version", hrad_version_text());
  json.field("scene", scene);
  json.field("patches", report.patches);
  json.field("dropped", report.dropped);
  json.field("two_sided", report.two_sided);
  json.field("blockers", report.blockers);
  json.field("emitters", report.emitters);
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
                   "their default.\n\nExample: hrad info room.obj --json");
  options.add_to(&parser, "info", RunOptions::a_scene);
  parser.add_flag("--json", &as_json, "Print one JSON object");
  if (!parser.parse(arguments, &output->text())) return 0;
  options.check();

  Session session(options);
  session.load();
  const std::string obstacle = session.inspect();
  SceneReport report = make_scene_report(&session);
  if (!obstacle.empty()) report.diagnostics.push_back("can't be solved: " + obstacle);
  (as_json ? append_json : append_text)(&output->text(), options.scene(), report,
                                        parameter_values(session));
  return 0;
}

}  // namespace hrad::cli
