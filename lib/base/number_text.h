// Numbers as text: the shortest decimal that reads back as the same number, whatever the locale.
// Floor 1 (base).
#pragma once

#include <charconv>
#include <string>

namespace hrad {

template <class Number>
void append_number(std::string& text, Number value) {
  char digits[32];  // the longest double takes 24 characters, the longest int64_t 20
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

template <class Number>
std::string number_text(Number value) {
  std::string text;
  append_number(text, value);
  return text;
}

}  // namespace hrad
