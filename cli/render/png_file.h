// Pictures as PNG files. The only place that knows libpng. CLI: public headers only.
#pragma once

#include <string>

#include "render/image.h"

namespace hrad::cli {

// Failure (usage) in a build without libpng, for which `path` was asked.
void require_png(const std::string& path);

// The file appears whole or not at all. Failure (input/output).
void write_png(const Image& image, const std::string& path);

}  // namespace hrad::cli
