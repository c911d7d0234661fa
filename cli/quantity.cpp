// The table of quantities (quantity.h). CLI: public headers only.
#include "quantity.h"

#include "arguments.h"

namespace hrad::cli {
namespace {

constexpr Quantity quantities[] = {{"radiosity", HRAD_RADIOSITY},
                                   {"irradiance", HRAD_IRRADIANCE},
                                   {"emission", HRAD_EMISSION},
                                   {"net_flux", HRAD_NET_FLUX}};

}  // namespace

Quantity read_quantity(const std::string& name, const std::string& command) {
  for (const Quantity& quantity : quantities)
    if (name == quantity.name) return quantity;
  fail_usage(command,
             "--quantity takes radiosity, irradiance, emission or net_flux, not '" + name + "'");
}

}  // namespace hrad::cli
