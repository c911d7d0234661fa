// Numbers as text, the same in every locale: strict reading, shortest writing that reads back to
// the same bits. CLI: public headers only.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hrad::cli {

// The whole text must be one finite number in range; false otherwise, and the output is untouched.
bool read_real(std::string_view text, double* value);
bool read_integer(std::string_view text, int64_t* value);

// Three reals separated by commas.
bool read_vector(std::string_view text, std::array<double, 3>* value);

std::vector<std::string_view> split(std::string_view text, char separator);

// "nan" and "inf" can come out of append_real; a caller that must not write them looks first.
void append_real(std::string* text, double value);
void append_integer(std::string* text, int64_t value);
std::string real_text(double value);

// For people: a few significant digits.
std::string short_text(double value, int digits);
std::string seconds_text(double seconds);  // 0.12 s, 3:05 min, 1:02:03 h
std::string bytes_text(int64_t bytes);     // 512 B, 1.5 MiB

}  // namespace hrad::cli
