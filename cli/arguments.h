// The arguments of one command: what it takes, its --help, and the errors of those who call it.
// The only place that knows CLI11. CLI: public headers only.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hrad::cli {

class Arguments {
 public:
  // `notes` stands below the options in --help.
  Arguments(const std::string& command, const std::string& summary, const std::string& notes);
  ~Arguments();

  // Values stay text here: whoever uses one reads it, strictly. `value_name` is what --help shows.
  void add_positional(const std::string& name, std::string* value, const std::string& help,
                      bool required = true);
  void add_flag(const std::string& names, bool* value, const std::string& help);
  void add_option(const std::string& names, const std::string& value_name,
                  std::optional<std::string>* value, const std::string& help);
  void add_list(const std::string& names, const std::string& value_name,
                std::vector<std::string>* values, const std::string& help);
  void exclude(const std::string& one, const std::string& other);

  // False: --help was asked for, and `help_text` has it. Failure (usage) for anything wrong.
  bool parse(const std::vector<std::string>& arguments, std::string* help_text);

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

// A Failure with exit code 2 and the hint to look at a command's --help.
[[noreturn]] void fail_usage(const std::string& command, const std::string& message);

}  // namespace hrad::cli
