// Typed errors: what a user did wrong or what the machine refused, thrown inside the library and
// turned into a status by lib/api. Floor 1 (base).
#pragma once

#include <cstdint>
#include <exception>
#include <string>
#include <utility>

namespace hrad {

// The values are those of hrad_status in hrad.h; a test holds them together.
enum class Status : int32_t {
  ok = 0,
  not_converged = 1,
  stopped = 2,
  argument = -1,
  state = -2,
  memory = -3,
  file = -4,
  format = -5,
  scene = -6,
  mpi = -7,
  unsupported = -8,
  internal = -9
};

class Error : public std::exception {
 public:
  Error(Status status, std::string message) : status_(status), message_(std::move(message)) {}
  Status status() const { return status_; }
  const char* what() const noexcept override { return message_.c_str(); }

 private:
  Status status_;
  std::string message_;
};

// Throws an Error whose message is formatted as by printf.
[[noreturn]] void fail(Status status, const char* format, ...)
    __attribute__((format(printf, 2, 3)));

// The same formatting, into a string.
std::string format(const char* format, ...) __attribute__((format(printf, 1, 2)));

}  // namespace hrad
