// Statements, words and numbers of OBJ and MTL texts. Floor 3 (scene).
#include "scene/obj_lexer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/error.h"

namespace hrad {

namespace {

constexpr double largest_number = 1e30;  // as in the C interface; squares and cubes stay finite
constexpr size_t longest_quote = 60;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

// Where a comment begins, or npos.
size_t comment_start(std::string_view line) {
  size_t at = line.find('#');
  while (at != std::string_view::npos && at > 0 && !is_blank(line[at - 1]))
    at = line.find('#', at + 1);
  return at;
}

}  // namespace

std::string quoted(std::string_view word) {
  std::string result = "'";
  for (char c : word.substr(0, longest_quote)) {
    const unsigned char byte = static_cast<unsigned char>(c);
    result += byte < 0x20 || byte == 0x7f ? '?' : c;
  }
  return result + (word.size() > longest_quote ? "...'" : "'");
}

void split_words(std::string_view text, std::vector<std::string_view>& words) {
  words.clear();
  size_t i = 0;
  while (true) {
    while (i < text.size() && is_blank(text[i])) ++i;
    if (i == text.size()) return;
    const size_t begin = i;
    while (i < text.size() && !is_blank(text[i])) ++i;
    words.push_back(text.substr(begin, i - begin));
  }
}

bool parse_integer(std::string_view word, int64_t& value) {
  const char* end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, value);
  return result.ec == std::errc() && result.ptr == end;
}

bool parse_number(std::string_view word, double& value) {
  // from_chars knows no plus sign; files have it.
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const char* end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, value, std::chars_format::general);
  return result.ec == std::errc() && result.ptr == end && std::isfinite(value);
}

ObjLexer::ObjLexer(std::string path, std::string_view text) : path_(std::move(path)), text_(text) {
  if (text_.substr(0, 3) == "\xef\xbb\xbf") text_.remove_prefix(3);
  if (!text_.empty() && std::memchr(text_.data(), 0, text_.size()))
    fail(Status::scene, "%s: not a text file (it has zero bytes)", path_.c_str());
}

std::string ObjLexer::place(int64_t line) const { return path_ + ":" + std::to_string(line); }

void ObjLexer::fail_at(int64_t line, const std::string& message) const {
  throw Error(Status::scene, place(line) + ": " + message);
}

// The next line without its end. There must be one.
std::string_view ObjLexer::physical_line() {
  const size_t end = std::min(text_.find_first_of("\n\r", position_), text_.size());
  const std::string_view line = text_.substr(position_, end - position_);
  position_ = end + 1;
  if (text_.substr(end, 2) == "\r\n") ++position_;
  ++lines_read_;
  return line;
}

bool ObjLexer::next() {
  words_known_ = false;
  while (position_ < text_.size()) {
    std::string_view statement = physical_line();
    line_ = lines_read_;
    if (statement.substr(0, own_mark.size()) == own_mark) {
      keyword_ = own_mark;
      rest_ = trimmed(statement.substr(own_mark.size()));
      return true;
    }
    size_t comment = comment_start(statement);
    if (comment != std::string_view::npos) {
      statement = statement.substr(0, comment);
    } else if (!statement.empty() && statement.back() == '\\') {
      joined_.assign(statement.substr(0, statement.size() - 1));
      bool goes_on = true;
      while (goes_on && position_ < text_.size()) {
        std::string_view piece = physical_line();
        comment = comment_start(piece);
        goes_on = comment == std::string_view::npos && !piece.empty() && piece.back() == '\\';
        if (goes_on) piece.remove_suffix(1);
        joined_ += ' ';
        joined_ += piece.substr(0, comment);
      }
      statement = joined_;
    }
    statement = trimmed(statement);
    if (statement.empty()) continue;
    size_t end = 0;
    while (end < statement.size() && !is_blank(statement[end])) ++end;
    keyword_ = statement.substr(0, end);
    rest_ = trimmed(statement.substr(end));
    return true;
  }
  return false;
}

const std::vector<std::string_view>& ObjLexer::words() {
  if (!words_known_) split_words(rest_, words_);
  words_known_ = true;
  return words_;
}

double ObjLexer::number(size_t i) {
  const std::string_view word = words()[i];
  double value;
  if (!parse_number(word, value)) fail_here(quoted(word) + " is not a number");
  if (!(std::fabs(value) <= largest_number)) fail_here(quoted(word) + " is beyond 1e30");
  return value;
}

}  // namespace hrad
