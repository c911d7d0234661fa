// Formatting of error messages. Floor 1 (base).
#include "base/error.h"

#include <cstdarg>
#include <cstdio>

namespace hrad {
namespace {

std::string format_list(const char* text, va_list arguments) {
  va_list copy;
  va_copy(copy, arguments);
  const int length = std::vsnprintf(nullptr, 0, text, copy);
  va_end(copy);
  std::string result(length > 0 ? static_cast<size_t>(length) : 0, '\0');
  if (length > 0) std::vsnprintf(&result[0], result.size() + 1, text, arguments);
  return result;
}

}  // namespace

void fail(Status status, const char* text, ...) {
  va_list arguments;
  va_start(arguments, text);
  std::string message = format_list(text, arguments);
  va_end(arguments);
  throw Error(status, std::move(message));
}

std::string format(const char* text, ...) {
  va_list arguments;
  va_start(arguments, text);
  std::string result = format_list(text, arguments);
  va_end(arguments);
  return result;
}

}  // namespace hrad
