// The version, for files that name what wrote them. Floor 1 (base).
#pragma once

namespace hrad {

// "major.minor.patch", static.
const char* version_text();

}  // namespace hrad
