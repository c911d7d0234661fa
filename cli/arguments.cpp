// Parsing arguments with CLI11 (arguments.h). CLI: public headers only.
#include "arguments.h"

#include <CLI/CLI.hpp>

#include "exit_code.h"

namespace hrad::cli {
namespace {

// CLI11's help without its remarks on which options exclude which.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() {
    column_width(36);
    label("Positionals", "Arguments");
  }
  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string& text = option->get_option_text();
    return text.empty() ? "" : " " + text;
  }
  std::string make_footer(const CLI::App* app) const override { return app->get_footer() + "\n"; }
};

}  // namespace

struct Arguments::Parser {
  explicit Parser(const std::string& command, const std::string& summary)
      : command(command), app(summary, "hrad " + command) {}
  std::string command;
  CLI::App app;
};

void fail_usage(const std::string& command, const std::string& message) {
  const std::string name = command.empty() ? "hrad" : "hrad " + command;
  throw Failure(exit_usage, message, "try '" + name + " --help'");
}

Arguments::Arguments(const std::string& command, const std::string& summary,
                     const std::string& notes)
    : parser_(std::make_unique<Parser>(command, summary)) {
  CLI::App& app = parser_->app;
  app.set_help_flag("-h,--help", "Print this help and exit");
  app.formatter(std::make_shared<HelpFormatter>());
  app.footer(notes);
}

Arguments::~Arguments() = default;

void Arguments::add_positional(const std::string& name, std::string* value, const std::string& help,
                               bool required) {
  parser_->app.add_option(name, *value, help)->required(required)->option_text(" ");
}

void Arguments::add_flag(const std::string& names, bool* value, const std::string& help) {
  parser_->app.add_flag_callback(
      names, [value] { *value = true; }, help);
}

void Arguments::add_option(const std::string& names, const std::string& value_name,
                           std::optional<std::string>* value, const std::string& help) {
  parser_->app
      .add_option_function<std::string>(
          names, [value](const std::string& text) { *value = text; }, help)
      ->option_text(value_name);
}

void Arguments::add_list(const std::string& names, const std::string& value_name,
                         std::vector<std::string>* values, const std::string& help) {
  parser_->app.add_option(names, *values, help)
      ->option_text(value_name + " ...")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
}

void Arguments::exclude(const std::string& one, const std::string& other) {
  parser_->app.get_option(one)->excludes(parser_->app.get_option(other));
}

bool Arguments::parse(const std::vector<std::string>& arguments, std::string* help_text) {
  // CLI11 takes its arguments from the back.
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
  try {
    parser_->app.parse(reversed);
  } catch (const CLI::CallForHelp&) {
    // CLI11 leaves a second blank line where a group without a name would stand.
    *help_text = CLI::detail::find_and_replace(parser_->app.help(), "\n\n\n", "\n\n");
    return false;
  } catch (const CLI::ExtrasError&) {
    fail_usage(parser_->command, "unexpected argument '" + parser_->app.remaining().front() + "'");
  } catch (const CLI::ArgumentMismatch& error) {
    // CLI11 counts, in words that depend on the option's kind.
    const std::string text = error.what();
    const bool missing = text.find("missing") != std::string::npos;
    fail_usage(parser_->command, text.substr(0, text.find(':')) +
                                     (missing ? " needs a value" : " is given more than once"));
  } catch (const CLI::ParseError& error) {
    fail_usage(parser_->command, error.what());
  }
  return true;
}

}  // namespace hrad::cli
