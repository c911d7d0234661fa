// Rows of text in aligned columns, for people. CLI: public headers only.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hrad::cli {

// A name out of a file as it may stand in a table: cut when long, control characters replaced.
std::string cell_text(const std::string& name);

class TextTable {
 public:
  // One letter per column: 'l' aligns left, 'r' right; columns without a letter align left.
  explicit TextTable(std::string alignment) : alignment_(std::move(alignment)) {}
  void add_row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  bool empty() const { return rows_.empty(); }
  // The rows with two blanks between columns, `indent` blanks before, none behind.
  std::string text(size_t indent = 0) const;

 private:
  std::string alignment_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace hrad::cli
