// Messages on their way to the user's log function; silent without one. Floor 1 (base).
#pragma once

#include <cstdint>
#include <string>

namespace hrad {

struct Log {
  enum Level : int32_t { error = 0, warning = 1, info = 2, debug = 3 };
  void (*function)(int32_t level, const char* message, void* user) = nullptr;
  void* user = nullptr;
  int32_t level = warning;

  void write(Level message_level, const std::string& message) const {
    if (function && message_level <= level) function(message_level, message.c_str(), user);
  }
};

}  // namespace hrad
