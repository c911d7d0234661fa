// Aligned columns (text_table.h). CLI: public headers only.
#include "text_table.h"

#include <algorithm>

namespace hrad::cli {
namespace {

constexpr size_t longest_cell = 60;  // characters

// Characters, not bytes: UTF-8 continuation bytes take no room.
size_t width_of(const std::string& text) {
  return static_cast<size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) >> 6) != 2; }));
}

}  // namespace

std::string cell_text(const std::string& name) {
  std::string result;
  size_t characters = 0;
  for (size_t i = 0; i < name.size(); ++i) {
    const auto byte = static_cast<unsigned char>(name[i]);
    characters += byte >> 6 != 2;
    if (characters > longest_cell) return result + "...";
    // U+0080 to U+009F, the second set of control characters, are two bytes of UTF-8.
    const bool second_set =
        byte == 0xc2 && i + 1 < name.size() && static_cast<unsigned char>(name[i + 1]) < 0xa0;
    result += byte < 0x20 || byte == 0x7f || second_set ? '?' : name[i];
    i += second_set;
  }
  return result;
}

std::string TextTable::text(size_t indent) const {
  std::vector<size_t> widths;
  for (const auto& row : rows_) {
    widths.resize(std::max(widths.size(), row.size()));
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  }
  std::string result;
  for (const auto& row : rows_) {
    std::string line(indent, ' ');
    for (size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - width_of(row[i]), ' ');
      const bool right = i < alignment_.size() && alignment_[i] == 'r';
      if (i > 0) line += "  ";
      line += right ? padding + row[i] : row[i] + padding;
    }
    line.erase(line.find_last_not_of(' ') + 1);
    result += line + "\n";
  }
  return result;
}

}  // namespace hrad::cli
