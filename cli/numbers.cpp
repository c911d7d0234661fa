// Numbers as text (numbers.h). CLI: public headers only.
#include "numbers.h"

#include <charconv>
#include <cmath>
#include <cstdio>

namespace hrad::cli {
namespace {

template <typename Number>
bool read_number(std::string_view text, Number* value) {
  // from_chars takes no plus sign; people write one.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Number number{};
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return false;
  *value = number;
  return true;
}

template <typename Number>
void append_number(std::string* text, Number value) {
  char buffer[40];  // the shortest form of a double has at most 24 characters
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
  text->append(buffer, result.ptr);
}

}  // namespace

bool read_real(std::string_view text, double* value) {
  double number = 0;
  if (!read_number(text, &number) || !std::isfinite(number)) return false;
  *value = number;
  return true;
}

bool read_integer(std::string_view text, int64_t* value) { return read_number(text, value); }

bool read_vector(std::string_view text, std::array<double, 3>* value) {
  const auto parts = split(text, ',');
  if (parts.size() != 3) return false;
  std::array<double, 3> read{};
  for (size_t i = 0; i < 3; ++i)
    if (!read_real(parts[i], &read[i])) return false;
  *value = read;
  return true;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

void append_real(std::string* text, double value) { append_number(text, value); }

void append_integer(std::string* text, int64_t value) { append_number(text, value); }

std::string real_text(double value) {
  std::string text;
  append_real(&text, value);
  return text;
}

std::string short_text(double value, int digits) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*g", digits, value);
  return buffer;
}

std::string seconds_text(double seconds) {
  char buffer[64];
  if (seconds < 60) {
    std::snprintf(buffer, sizeof buffer, "%.2f s", seconds);
    return buffer;
  }
  const long long whole = std::llround(seconds);
  if (whole < 3600)
    std::snprintf(buffer, sizeof buffer, "%lld:%02lld min", whole / 60, whole % 60);
  else
    std::snprintf(buffer, sizeof buffer, "%lld:%02lld:%02lld h", whole / 3600, whole / 60 % 60,
                  whole % 60);
  return buffer;
}

std::string bytes_text(int64_t bytes) {
  const char* const units[] = {"B", "KiB", "MiB", "GiB", "TiB"};
  double value = static_cast<double>(bytes);
  size_t unit = 0;
  for (; value >= 1024 && unit + 1 < std::size(units); ++unit) value /= 1024;
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, unit == 0 ? "%.0f %s" : "%.1f %s", value, units[unit]);
  return buffer;
}

}  // namespace hrad::cli
