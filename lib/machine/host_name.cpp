// As the system tells it. Floor 2 (machine).
#include "machine/host_name.h"

#include <unistd.h>

namespace hrad {

std::string host_name() {
  char name[256] = "";
  ::gethostname(name, sizeof name - 1);
  return name;
}

}  // namespace hrad
