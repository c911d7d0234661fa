// The name of this node, for messages and for files that several nodes write. Floor 2 (machine).
#pragma once

#include <string>

namespace hrad {

std::string host_name();

}  // namespace hrad
