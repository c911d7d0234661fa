// Reading where sensors stand (sensors.h). CLI: public headers only.
#include "sensors.h"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>

#include "arguments.h"
#include "exit_code.h"
#include "launcher.h"
#include "numbers.h"

namespace hrad::cli {
namespace {

using Vector = std::array<double, 3>;

constexpr int64_t most_cells = 100'000'000;

bool is_zero(const Vector& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

void add(const Vector& position, const Vector& normal, Sensors* sensors) {
  sensors->xyz.insert(sensors->xyz.end(), position.begin(), position.end());
  sensors->normal.insert(sensors->normal.end(), normal.begin(), normal.end());
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

void skip_blanks(std::string_view* text) {
  while (!text->empty() && is_blank(text->front())) text->remove_prefix(1);
}

// The six numbers of a line without its comment; what is wrong with it otherwise, "" if nothing is.
// A line without anything has no numbers.
std::string read_line(std::string_view line, std::vector<double>* numbers) {
  skip_blanks(&line);
  while (!line.empty()) {
    size_t length = 0;
    while (length < line.size() && !is_blank(line[length]) && line[length] != ',') ++length;
    if (length == 0) return "a number is missing before a comma";
    double number = 0;
    if (!read_real(line.substr(0, length), &number))
      return "'" + std::string(line.substr(0, length)) + "' is not a number";
    numbers->push_back(number);
    line.remove_prefix(length);
    skip_blanks(&line);
    if (line.empty() || line.front() != ',') continue;
    line.remove_prefix(1);
    skip_blanks(&line);
    if (line.empty()) return "a number is missing behind the last comma";
  }
  if (!numbers->empty() && numbers->size() != 6)
    return "six numbers wanted (position and normal), not " + std::to_string(numbers->size());
  if (numbers->size() == 6 && is_zero({(*numbers)[3], (*numbers)[4], (*numbers)[5]}))
    return "the normal has no length";
  return "";
}

std::string read_file(const std::string& path) {
  const auto fail = [&](const char* doing) {
    throw Failure(exit_input_output,
                  std::string("can't ") + doing + " '" + path + "': " + std::strerror(errno));
  };
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> opened(nullptr, std::fclose);
  std::FILE* file = stdin;
  if (path != "-") {
    opened.reset(std::fopen(path.c_str(), "rb"));
    if (!opened) fail("open");
    file = opened.get();
  }
  std::string content;
  char buffer[65536];
  while (const size_t got = std::fread(buffer, 1, sizeof buffer, file)) content.append(buffer, got);
  if (std::ferror(file)) fail("read");
  return content;
}

[[noreturn]] void fail_grid(const std::string& text, const std::string& why) {
  fail_usage("query", "--grid " + text + ": " + why);
}

bool read_cells(std::string_view text, int64_t cells[2]) {
  const auto parts = split(text, 'x');
  return parts.size() == 2 && read_integer(parts[0], &cells[0]) &&
         read_integer(parts[1], &cells[1]);
}

}  // namespace

void add_sensor(const std::string& text, Sensors* sensors) {
  const auto parts = split(text, ':');
  Vector position{}, normal{};
  if (parts.size() != 2 || !read_vector(parts[0], &position) || !read_vector(parts[1], &normal))
    fail_usage("query", "--at takes X,Y,Z:NX,NY,NZ, not '" + text + "'");
  if (is_zero(normal)) fail_usage("query", "--at " + text + ": the normal has no length");
  add(position, normal, sensors);
}

void add_sensor_file(const std::string& path, Sensors* sensors) {
  std::string content;
  launcher::on_first([&] { content = read_file(path); });
  launcher::share_of_first(&content);
  int64_t number = 0;
  for (std::string_view line : split(content, '\n')) {
    ++number;
    std::vector<double> numbers;
    const std::string wrong = read_line(line.substr(0, line.find('#')), &numbers);
    if (!wrong.empty())
      throw Failure(exit_input_output, (path == "-" ? "standard input" : path) + ":" +
                                           std::to_string(number) + ": " + wrong);
    if (!numbers.empty())
      add({numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}, sensors);
  }
}

SensorGrid add_sensor_grid(const std::string& text, Sensors* sensors) {
  const auto parts = split(text, ':');
  Vector from{}, to{};
  int64_t cells[2] = {0, 0};
  if (parts.size() != 3 || !read_vector(parts[0], &from) || !read_vector(parts[1], &to) ||
      !read_cells(parts[2], cells))
    fail_usage("query", "--grid takes X0,Y0,Z0:X1,Y1,Z1:NxM, not '" + text + "'");
  if (cells[0] < 1 || cells[1] < 1 || cells[0] > most_cells / cells[1])
    fail_grid(text, "there must be 1 to " + std::to_string(most_cells) + " cells");
  size_t axis = 3, equal = 0;
  for (size_t i = 0; i < 3; ++i) {
    if (from[i] != to[i]) continue;
    axis = i;
    ++equal;
  }
  if (equal != 1)
    fail_grid(text, "the corners must have exactly one coordinate in common, not " +
                        std::to_string(equal));
  const size_t first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
  const auto centre = [&](size_t along, int64_t cell, int64_t count) {
    const double share = (static_cast<double>(cell) + 0.5) / static_cast<double>(count);
    return from[along] * (1 - share) + to[along] * share;  // no overflow at the ends of the range
  };
  Vector normal{};
  normal[axis] = 1;
  for (int64_t j = 0; j < cells[1]; ++j)
    for (int64_t i = 0; i < cells[0]; ++i) {
      Vector position = from;
      position[first] = centre(first, i, cells[0]);
      position[second] = centre(second, j, cells[1]);
      add(position, normal, sensors);
    }
  return {{cells[0], cells[1]},
          {std::fabs(to[first] - from[first]), std::fabs(to[second] - from[second])},
          "xyz"[axis],
          from[axis]};
}

}  // namespace hrad::cli
