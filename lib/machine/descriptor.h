// Steps on an open file that may have to be taken again until they are done. Each gives 0 or the
// error number of the system. Floor 2 (machine).
#pragma once

#include <cstddef>
#include <cstdint>

namespace hrad {

int write_all(int file, uint64_t offset, const char* data, size_t size);
// What was written is on the disk.
int synchronise(int file);
// The number is -1 afterwards.
int close_checked(int& file);

}  // namespace hrad
