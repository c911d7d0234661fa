// Writing JSON (json.h). CLI: public headers only.
#include "json.h"

#include <cmath>

#include "numbers.h"

namespace hrad::cli {
namespace {

// The length of the well-formed UTF-8 sequence at the front of the text, 0 if there is none.
size_t sequence_length(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  size_t length = 0;
  unsigned least_second = 0x80, greatest_second = 0xBF;
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead <= 0xDF) {
    length = 2;
  } else if (lead >= 0xE0 && lead <= 0xEF) {
    length = 3;
    if (lead == 0xE0) least_second = 0xA0;     // no longer form than needed
    if (lead == 0xED) greatest_second = 0x9F;  // no surrogates
  } else if (lead >= 0xF0 && lead <= 0xF4) {
    length = 4;
    if (lead == 0xF0) least_second = 0x90;
    if (lead == 0xF4) greatest_second = 0x8F;  // nothing beyond U+10FFFF
  } else {
    return 0;
  }
  if (text.size() < length || byte(1) < least_second || byte(1) > greatest_second) return 0;
  for (size_t i = 2; i < length; ++i)
    if (byte(i) < 0x80 || byte(i) > 0xBF) return 0;
  return length;
}

}  // namespace

void JsonWriter::begin_object(std::string_view name, Layout layout) {
  key(name);
  begin('{', layout);
}

void JsonWriter::begin_array(std::string_view name, Layout layout) {
  key(name);
  begin('[', layout);
}

void JsonWriter::begin(char opening, Layout layout) {
  separate();
  *text_ += opening;
  // Inside one line everything stays on that line.
  if (!levels_.empty() && levels_.back().layout == one_line) layout = one_line;
  levels_.push_back({opening == '{' ? '}' : ']', layout, true});
}

void JsonWriter::end() {
  const Level level = levels_.back();
  levels_.pop_back();
  if (!level.empty && level.layout == many_lines) indent();
  *text_ += level.closing;
  if (levels_.empty()) *text_ += '\n';
}

void JsonWriter::value(std::string_view text) {
  separate();
  quote(text);
}

void JsonWriter::value(double number) {
  if (!std::isfinite(number)) return null();
  separate();
  append_real(text_, number);
}

void JsonWriter::value(int64_t number) {
  separate();
  append_integer(text_, number);
}

void JsonWriter::value(bool truth) {
  separate();
  *text_ += truth ? "true" : "false";
}

void JsonWriter::null() {
  separate();
  *text_ += "null";
}

void JsonWriter::field(std::string_view name, const double* numbers, int64_t count) {
  begin_array(name, one_line);
  for (int64_t i = 0; i < count; ++i) value(numbers[i]);
  end();
}

void JsonWriter::key(std::string_view name) {
  separate();
  quote(name);
  *text_ += ": ";
  after_key_ = true;
}

void JsonWriter::separate() {
  if (after_key_) {
    after_key_ = false;
    return;
  }
  if (levels_.empty()) return;
  Level& level = levels_.back();
  if (!level.empty) *text_ += level.layout == one_line ? ", " : ",";
  level.empty = false;
  if (level.layout == many_lines) indent();
}

void JsonWriter::indent() {
  *text_ += '\n';
  text_->append(2 * levels_.size(), ' ');
}

void JsonWriter::quote(std::string_view text) {
  const char digits[] = "0123456789abcdef";
  *text_ += '"';
  while (!text.empty()) {
    const size_t length = sequence_length(text);
    const char c = text[0];
    if (length == 0) {
      *text_ += "\\ufffd";  // a file name may hold any bytes, JSON text may not
      text.remove_prefix(1);
      continue;
    }
    if (c == '"' || c == '\\') {
      *text_ += '\\';
      *text_ += c;
    } else if (c == '\n') {
      *text_ += "\\n";
    } else if (c == '\t') {
      *text_ += "\\t";
    } else if (length == 1 && static_cast<unsigned char>(c) < 0x20) {
      *text_ += "\\u00";
      *text_ += digits[c >> 4];
      *text_ += digits[c & 15];
    } else {
      text_->append(text.substr(0, length));
    }
    text.remove_prefix(length);
  }
  *text_ += '"';
}

}  // namespace hrad::cli
