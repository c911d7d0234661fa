// The version that the build states. Floor 1 (base).
#include "base/version.h"

namespace hrad {

const char* version_text() { return HRAD_VERSION; }

}  // namespace hrad
