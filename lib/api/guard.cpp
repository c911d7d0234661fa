// From exceptions to statuses and texts. Floor 9 (api).
#include "api/guard.h"

#include <cstdio>
#include <new>
#include <stdexcept>

namespace hrad {
namespace api {
namespace {

// Without allocation or destructor: it must serve when memory is short and when a thread ends. Room
// for the longest path and a sentence around it.
thread_local char error_text[6144] = "";

constexpr char kOutOfMemory[] =
    "out of memory: use a smaller scene, or a larger accuracy or min_area";

}  // namespace

void remember_error(const char* message) noexcept {
  std::snprintf(error_text, sizeof error_text, "%s", message);
}

const char* last_error() noexcept { return error_text; }

hrad_status status_of_current_exception() noexcept {
  try {
    throw;
  } catch (const Error& error) {
    remember_error(error.what());
    return static_cast<hrad_status>(error.status());
  } catch (const std::bad_alloc&) {
    remember_error(kOutOfMemory);
    return HRAD_ERROR_MEMORY;
  } catch (const std::length_error&) {  // an array that no memory could hold
    remember_error(kOutOfMemory);
    return HRAD_ERROR_MEMORY;
  } catch (const std::exception& error) {
    std::snprintf(error_text, sizeof error_text, "a fault of the library, please report it: %s",
                  error.what());
    return HRAD_ERROR_INTERNAL;
  } catch (...) {
    remember_error("a fault of the library, please report it: an exception of unknown type");
    return HRAD_ERROR_INTERNAL;
  }
}

}  // namespace api
}  // namespace hrad
