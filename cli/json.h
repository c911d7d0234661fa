// Writes JSON text: correct escapes, numbers that read back to the same bits, null for what isn't a
// finite number. CLI: public headers only.
//
//   JsonWriter json(&text);
//   json.begin_object();
//   json.field("patches", 36);
//   json.begin_array("emitted", JsonWriter::one_line);
//   json.value(12.5);
//   json.end();
//   json.end();
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hrad::cli {

class JsonWriter {
 public:
  enum Layout { many_lines, one_line };

  explicit JsonWriter(std::string* text) : text_(text) {}

  void begin_object(Layout layout = many_lines) { begin('{', layout); }
  void begin_array(Layout layout = many_lines) { begin('[', layout); }
  void begin_object(std::string_view name, Layout layout = many_lines);
  void begin_array(std::string_view name, Layout layout = many_lines);
  void end();  // of the innermost object or array; the outermost one ends the line

  void value(std::string_view text);
  void value(const char* text) { value(std::string_view(text)); }
  void value(double number);
  void value(int64_t number);
  void value(int32_t number) { value(static_cast<int64_t>(number)); }
  void value(bool truth);
  void null();

  template <typename Value>
  void field(std::string_view name, const Value& content) {
    key(name);
    value(content);
  }
  void field(std::string_view name, const double* numbers, int64_t count);

 private:
  struct Level {
    char closing;
    Layout layout;
    bool empty;
  };
  void begin(char opening, Layout layout);
  void key(std::string_view name);
  void separate();  // what stands before the next element
  void indent();
  void quote(std::string_view text);

  std::string* text_;
  std::vector<Level> levels_;
  bool after_key_ = false;
};

}  // namespace hrad::cli
