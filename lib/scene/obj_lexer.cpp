// Statements, words and numbers of OBJ and MTL texts. Floor 3 (scene).
#include "scene/obj_lexer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
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

// Whether a number that no double holds, 0 or infinity to one, is the latter: the power of ten of
// its first digit other than 0 decides.
bool is_large(std::string_view number) {
  const size_t exponent_at = number.find_first_of("eE");
  const std::string_view digits = number.substr(0, exponent_at);
  int64_t exponent = 0;
  if (exponent_at != std::string_view::npos) {
    std::string_view word = number.substr(exponent_at + 1);
    if (word[0] == '+') word.remove_prefix(1);
    // An exponent that overflows too outweighs all digits, and so does one far from overflow.
    constexpr int64_t more_than_digits = int64_t{1} << 60;
    if (!parse_integer(word, exponent)) return word[0] != '-';
    exponent = std::clamp(exponent, -more_than_digits, more_than_digits);
  }
  const size_t point = std::min(digits.find('.'), digits.size());
  const size_t first = std::min(digits.find_first_of("123456789"), digits.size());
  return exponent + static_cast<int64_t>(point) - static_cast<int64_t>(first) > 0;
}

}  // namespace

std::string quoted(std::string_view word) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(word[i]); };
  size_t end = std::min(word.size(), longest_quote);
  if (end < word.size())  // not inside a character of UTF-8, which has up to four bytes
    for (int i = 0; i < 3 && byte(end) >> 6 == 2; ++i) --end;
  std::string result = "'";
  for (size_t i = 0; i < end; ++i) {
    // The second set of control characters, U+0080 to U+009F, has two bytes.
    const bool second_set = byte(i) == 0xc2 && i + 1 < end && byte(i + 1) < 0xa0;
    result += byte(i) < 0x20 || byte(i) == 0x7f || second_set ? '?' : word[i];
    i += second_set;
  }
  return result + (end < word.size() ? "...'" : "'");
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

NumberForm parse_number(std::string_view word, double& value) {
  // from_chars knows no plus sign; files have it.
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const char* end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, value, std::chars_format::general);
  if (result.ptr != end) return NumberForm::none;
  if (result.ec == std::errc()) return std::isfinite(value) ? NumberForm::number : NumberForm::none;
  if (result.ec != std::errc::result_out_of_range) return NumberForm::none;
  if (is_large(word)) return NumberForm::too_large;
  value = 0;
  return NumberForm::too_small;
}

ObjLexer::ObjLexer(std::string path, std::string_view text) : path_(std::move(path)), text_(text) {
  refuse_what_is_no_text();
  if (text_.substr(0, 3) == "\xef\xbb\xbf") text_.remove_prefix(3);
}

void ObjLexer::refuse_what_is_no_text() const {
  const std::string_view mark = text_.substr(0, 2);
  const size_t zero = text_.find('\0');
  if (mark == "\xff\xfe" || mark == "\xfe\xff" || (zero < 2 && text_.size() > 2))
    fail_at(1, "this is UTF-16 or UTF-32 text, or no text at all: save it as UTF-8");
  if (zero == std::string_view::npos) return;
  int64_t line = 1;
  for (size_t i = 0; i < zero; ++i)
    line += text_[i] == '\n' || (text_[i] == '\r' && text_[i + 1] != '\n');
  fail_at(line, "a zero byte: this is not a text file, or it is damaged");
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
  double value = 0;
  const NumberForm form = parse_number(word, value);
  if (form == NumberForm::none) fail_here(quoted(word) + " is not a number");
  if (form == NumberForm::too_large || std::fabs(value) > largest_number)
    fail_here(quoted(word) + " is beyond 1e30");
  if (form == NumberForm::too_small && vanished_++ == 0) first_vanished_ = line_;
  return value;
}

}  // namespace hrad
