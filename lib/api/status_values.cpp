// Holds the constants of hrad.h and of the floors below together. Floor 9 (api).
#include "base/error.h"
#include "base/log.h"
#include "hrad/hrad.h"
#include "scene/scene.h"
#include "solver/solver.h"

namespace hrad {
namespace {

constexpr bool equal(Status status, hrad_status value) {
  return static_cast<hrad_status>(status) == value;
}
static_assert(equal(Status::ok, HRAD_OK), "");
static_assert(equal(Status::not_converged, HRAD_NOT_CONVERGED), "");
static_assert(equal(Status::stopped, HRAD_STOPPED), "");
static_assert(equal(Status::argument, HRAD_ERROR_ARGUMENT), "");
static_assert(equal(Status::state, HRAD_ERROR_STATE), "");
static_assert(equal(Status::memory, HRAD_ERROR_MEMORY), "");
static_assert(equal(Status::file, HRAD_ERROR_FILE), "");
static_assert(equal(Status::format, HRAD_ERROR_FORMAT), "");
static_assert(equal(Status::scene, HRAD_ERROR_SCENE), "");
static_assert(equal(Status::mpi, HRAD_ERROR_MPI), "");
static_assert(equal(Status::unsupported, HRAD_ERROR_UNSUPPORTED), "");
static_assert(equal(Status::internal, HRAD_ERROR_INTERNAL), "");

static_assert(int{Log::error} == int{HRAD_LOG_ERROR}, "");
static_assert(int{Log::warning} == int{HRAD_LOG_WARNING}, "");
static_assert(int{Log::info} == int{HRAD_LOG_INFO}, "");
static_assert(int{Log::debug} == int{HRAD_LOG_DEBUG}, "");

static_assert(int{patch_dropped} == int{HRAD_PATCH_DROPPED}, "");
static_assert(int{patch_two_sided} == int{HRAD_PATCH_TWO_SIDED}, "");
static_assert(int{patch_blocker} == int{HRAD_PATCH_BLOCKER}, "");

constexpr bool equal(Quantity quantity, int32_t value) {
  return static_cast<int32_t>(quantity) == value;
}
static_assert(equal(Quantity::radiosity, HRAD_RADIOSITY), "");
static_assert(equal(Quantity::irradiance, HRAD_IRRADIANCE), "");
static_assert(equal(Quantity::emission, HRAD_EMISSION), "");
static_assert(equal(Quantity::net_flux, HRAD_NET_FLUX), "");

// Rows of the parameter table name their types by the numbers of hrad_param.
static_assert(HRAD_PARAM_INT == 0 && HRAD_PARAM_DOUBLE == 1 && HRAD_PARAM_TEXT == 2, "");

}  // namespace
}  // namespace hrad
