// cmocka for C++: a failed CHECK throws, so that destructors run, and the failure is reported to
// cmocka (which leaves by longjmp) from a frame that holds no C++ object.
#pragma once

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
// cmocka.h wants the headers above first, and doesn't say that it is C.
extern "C" {
#include <cmocka.h>
}

#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

namespace hrad_test {

struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[noreturn]] inline void failed(const char* file, int line, const std::string& what) {
  throw Failure(std::string(file) + ":" + std::to_string(line) + ": " + what);
}

// Runs a test body; returns false and fills the message when it threw.
inline bool runs(void (*body)(), char* message, size_t size) {
  try {
    body();
    return true;
  } catch (const std::exception& e) {
    std::snprintf(message, size, "%s", e.what());
  } catch (...) {
    std::snprintf(message, size, "an unknown exception");
  }
  return false;
}

template <void (*body)()>
void run(void**) {
  static char message[4096];
  if (!runs(body, message, sizeof message)) fail_msg("%s", message);
}

}  // namespace hrad_test

#define CHECK(condition)                                                              \
  do {                                                                                \
    if (!(condition)) hrad_test::failed(__FILE__, __LINE__, "not true: " #condition); \
  } while (0)

// |a - b| <= tolerance
#define CHECK_NEAR(a, b, tolerance)                                                        \
  do {                                                                                     \
    const double check_a = (a), check_b = (b), check_t = (tolerance);                      \
    if (!(std::fabs(check_a - check_b) <= check_t)) {                                      \
      char check_text[256];                                                                \
      std::snprintf(check_text, sizeof check_text, "%s = %.12g, wanted %.12g +- %.3g", #a, \
                    check_a, check_b, check_t);                                            \
      hrad_test::failed(__FILE__, __LINE__, check_text);                                   \
    }                                                                                      \
  } while (0)

#define CHECK_EQUAL(a, b)                                                                    \
  do {                                                                                       \
    const auto check_a = (a);                                                                \
    const auto check_b = (b);                                                                \
    if (!(check_a == check_b))                                                               \
      hrad_test::failed(__FILE__, __LINE__,                                                  \
                        std::string(#a " != " #b ": ") + std::to_string(check_a) + " and " + \
                            std::to_string(check_b));                                        \
  } while (0)

// The statement throws hrad::Error of this status, and its message contains the text.
#define CHECK_FAILS(statement, wanted_status, text)                                               \
  do {                                                                                            \
    bool check_threw = false;                                                                     \
    try {                                                                                         \
      statement;                                                                                  \
    } catch (const hrad::Error& e) {                                                              \
      check_threw = true;                                                                         \
      if (e.status() != (wanted_status) || std::string(e.what()).find(text) == std::string::npos) \
        hrad_test::failed(__FILE__, __LINE__, std::string("wrong error: ") + e.what());           \
    }                                                                                             \
    if (!check_threw) hrad_test::failed(__FILE__, __LINE__, "no error from " #statement);         \
  } while (0)

#define HRAD_TEST(function) cmocka_unit_test(hrad_test::run<function>)
