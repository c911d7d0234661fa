// What is thrown inside the library becomes a status and a message, whatever it is.
#include <new>
#include <stdexcept>
#include <string>

#include "api/guard.h"
#include "support/check.h"

namespace {

template <class Thrown>
hrad_status status_of(const Thrown& thrown) {
  return hrad::api::guarded([&] { throw thrown; });
}

bool message_has(const char* text) {
  return std::string(hrad::api::last_error()).find(text) != std::string::npos;
}

void errors_keep_their_status() {
  CHECK_EQUAL(status_of(hrad::Error(hrad::Status::scene, "no patch")), HRAD_ERROR_SCENE);
  CHECK(std::string(hrad::api::last_error()) == "no patch");
}

void no_memory_is_no_fault() {
  CHECK_EQUAL(status_of(std::bad_alloc()), HRAD_ERROR_MEMORY);
  CHECK(message_has("memory") && !message_has("fault"));
  CHECK_EQUAL(status_of(hrad::Error(hrad::Status::file, "other")), HRAD_ERROR_FILE);
  CHECK_EQUAL(status_of(std::length_error("vector")), HRAD_ERROR_MEMORY);
  CHECK(message_has("memory") && !message_has("fault"));
}

void anything_else_is_a_fault() {
  CHECK_EQUAL(status_of(std::runtime_error("no way out")), HRAD_ERROR_INTERNAL);
  CHECK(message_has("report") && message_has("no way out"));
  CHECK_EQUAL(status_of(42), HRAD_ERROR_INTERNAL);
  CHECK(message_has("report") && message_has("unknown"));
  // Of any length.
  CHECK_EQUAL(status_of(std::runtime_error(std::string(100000, 'x'))), HRAD_ERROR_INTERNAL);
  CHECK(message_has("xxx"));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(errors_keep_their_status), HRAD_TEST(no_memory_is_no_fault),
                              HRAD_TEST(anything_else_is_a_fault)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
