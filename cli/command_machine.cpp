// hrad machine. CLI: public headers only.
#include "command.h"
#include "exit_code.h"
#include "json.h"
#include "numbers.h"
#include "run_options.h"
#include "session.h"

namespace hrad::cli {
namespace {

// One `name: value` a line; a value that is a whole number becomes one.
void append_json(std::string* text, const std::string& description) {
  JsonWriter json(text);
  json.begin_object();
  for (std::string_view line : split(description, '\n')) {
    const size_t colon = line.find(':');
    if (colon == std::string_view::npos) continue;
    const std::string_view name = line.substr(0, colon);
    std::string_view value = line.substr(colon + 1);
    value.remove_prefix(std::min(value.find_first_not_of(' '), value.size()));
    int64_t number = 0;
    if (read_integer(value, &number))
      json.field(name, number);
    else
      json.field(name, value);
  }
  json.end();
}

}  // namespace

int run_machine(const std::vector<std::string>& arguments, Output* output) {
  RunOptions options;
  bool as_json = false;
  Arguments parser("machine",
                   "Print what is seen of this machine, and the threads that would start here.",
                   "Example: hrad machine --threads 4 --set bind=1");
  options.add_to(&parser, "machine", RunOptions::no_scene);
  parser.add_flag("--json", &as_json, "Print one JSON object");
  if (!parser.parse(arguments, &output->text())) return 0;
  if (!options.check()) return exit_done;

  Session session(options);
  const std::string text = fetch_text([&](char* buffer, int64_t size, int64_t* needed) {
    return hrad_describe_machine(session.solver(), buffer, size, needed);
  });
  if (as_json)
    append_json(&output->text(), text);
  else
    *output << text;
  if (!output->text().empty() && output->text().back() != '\n') *output << "\n";
  return 0;
}

}  // namespace hrad::cli
