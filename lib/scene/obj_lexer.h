// Statements of OBJ and MTL texts: a keyword and its arguments, with the line they stand on; strict
// numbers. (Wavefront, "Object Files", Appendix B1.) Floor 3 (scene).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hrad {

// Begins what OBJ and MTL can't say otherwise.
constexpr std::string_view own_mark = "# hrad:";

// Lines end with LF, CR LF or CR; a backslash at a line's end joins the next one. A comment begins
// with # at the start of a word and ends with its line, whatever that ends with. A byte-order mark
// is skipped. Nothing depends on the locale. A line that begins with own_mark is a statement with
// this keyword: what other programs skip as a comment.
class ObjLexer {
 public:
  // path: for messages. The text must outlive the lexer. SCENE when it isn't text.
  ObjLexer(std::string path, std::string_view text);

  // Goes to the next statement; false at the end.
  bool next();

  std::string_view keyword() const { return keyword_; }
  std::string_view rest() const { return rest_; }  // all after the keyword, trimmed
  const std::vector<std::string_view>& words();    // the same, cut at blanks
  int64_t line() const { return line_; }           // the statement's first, from 1
  const std::string& path() const { return path_; }
  std::string here() const { return place(line_); }  // "file:line"
  std::string place(int64_t line) const;

  // Word i as a finite number of at most 1e30 in magnitude. One too small for a double is 0.
  double number(size_t i);

  // How many numbers were too small, and the place of the first.
  int64_t vanished() const { return vanished_; }
  std::string first_vanished() const { return place(first_vanished_); }

  // Throws SCENE with file:line before the message.
  [[noreturn]] void fail_here(const std::string& message) const { fail_at(line_, message); }
  [[noreturn]] void fail_at(int64_t line, const std::string& message) const;

 private:
  std::string_view physical_line();
  void refuse_what_is_no_text() const;

  std::string path_;
  std::string_view text_;
  size_t position_ = 0;
  int64_t line_ = 0, lines_read_ = 0;
  int64_t vanished_ = 0, first_vanished_ = 0;
  std::string joined_;  // holds a statement of several lines
  std::string_view keyword_, rest_;
  std::vector<std::string_view> words_;
  bool words_known_ = false;
};

// A word for a message: quoted, cut between characters when long, control characters replaced.
std::string quoted(std::string_view word);

// The words of a text, cut at blanks and tabs.
void split_words(std::string_view text, std::vector<std::string_view>& words);

// The whole word as an integer; false when it is anything else (trailing characters, overflow).
bool parse_integer(std::string_view word, int64_t& value);

// The whole word as a number. `none` is anything else (nan, inf, hex, decimal commas, trailing
// characters); what is too small for a double becomes 0.
enum class NumberForm { number, none, too_large, too_small };
NumberForm parse_number(std::string_view word, double& value);

}  // namespace hrad
