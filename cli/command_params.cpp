// hrad params. CLI: public headers only.
#include "command.h"
#include "json.h"
#include "launcher.h"
#include "numbers.h"
#include "session.h"
#include "text_table.h"

namespace hrad::cli {
namespace {

const char* type_name(const hrad_param& row) {
  return row.type == HRAD_PARAM_INT ? "int" : row.type == HRAD_PARAM_DOUBLE ? "double" : "text";
}

// A limit of whole numbers in all its digits.
std::string limit_text(const hrad_param& row, double limit) {
  return row.type == HRAD_PARAM_INT ? std::to_string(static_cast<int64_t>(limit))
                                    : short_text(limit, 15);
}

std::string allowed_text(const hrad_param& row) {
  if (row.type == HRAD_PARAM_TEXT) return row.choices != nullptr ? row.choices : "any text";
  return limit_text(row, row.minimum) + " .. " + limit_text(row, row.maximum);
}

void append_table(std::string* text, const std::vector<hrad_param>& rows) {
  TextTable table("llrl");
  table.add_row({"NAME", "TYPE", "DEFAULT", "ALLOWED", "UNIT", "DECIDES", "MEANING"});
  for (const hrad_param& row : rows)
    table.add_row({row.name, type_name(row), row.default_text, allowed_text(row), row.unit,
                   row.is_result ? "result" : "run", row.help});
  *text += table.text();
}

void append_json(std::string* text, const std::vector<hrad_param>& rows) {
  JsonWriter json(text);
  json.begin_object();
  json.begin_array("parameters");
  for (const hrad_param& row : rows) {
    json.begin_object();
    json.field("name", row.name);
    json.field("type", type_name(row));
    json.field("default", row.default_text);
    if (row.type == HRAD_PARAM_INT) {
      json.field("minimum", static_cast<int64_t>(row.minimum));
      json.field("maximum", static_cast<int64_t>(row.maximum));
    } else if (row.type == HRAD_PARAM_DOUBLE) {
      json.field("minimum", row.minimum);
      json.field("maximum", row.maximum);
    } else if (row.choices != nullptr) {
      json.begin_array("choices", JsonWriter::one_line);
      for (std::string_view word : split(row.choices, '|')) json.value(word);
      json.end();
    }
    json.field("unit", row.unit);
    json.field("decides", row.is_result ? "result" : "run");
    json.field("help", row.help);
    json.end();
  }
  json.end();
  json.end();
}

}  // namespace

int run_params(const std::vector<std::string>& arguments, Output* output) {
  bool as_json = false;
  Arguments parser("params", "Print the table of parameters.",
                   "Parameters that decide the result are part of it; those that decide the run "
                   "never change\na bit of it. All are set by --set NAME=VALUE.");
  parser.add_flag("--json", &as_json, "Print one JSON object");
  if (!parser.parse(arguments, &output->text())) return 0;
  if (!launcher::start(launcher::Choice::automatic, launcher::Work::of_the_first)) return 0;
  (as_json ? append_json : append_table)(&output->text(), parameter_table());
  return 0;
}

}  // namespace hrad::cli
