// Files that the tool itself writes, the first of several processes alone: whole under their name
// or not at all. CLI: public headers only.
#pragma once

#include <cstddef>
#include <string>

namespace hrad::cli {

// The bytes go to a temporary beside the file, which then takes its place; a symbolic link is
// followed. Failure (input/output) with the system's reason; an old file is untouched then.
void write_whole_file(const std::string& path, const void* data, size_t size);

}  // namespace hrad::cli
