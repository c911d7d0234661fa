// Pictures as PNG files (png_file.h), by libpng's simplified interface, which takes no jumps. CLI:
// public headers only.
#include "render/png_file.h"

#include "exit_code.h"
#include "whole_file.h"

#ifdef HRAD_PNG
#include <png.h>
#endif

namespace hrad::cli {

#ifdef HRAD_PNG

void require_png(const std::string&) {}

void write_png(const Image& image, const std::string& path) {
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  description.format = PNG_FORMAT_RGB;
  description.width = static_cast<png_uint_32>(image.width);
  description.height = static_cast<png_uint_32>(image.height);
  std::vector<char> bytes(PNG_IMAGE_PNG_SIZE_MAX(description));
  png_alloc_size_t size = bytes.size();
  if (!png_image_write_to_memory(&description, bytes.data(), &size, 0, image.rgb.data(), 0,
                                 nullptr))
    throw Failure(exit_input_output,
                  "can't write '" + path + "': " + std::string(description.message));
  write_whole_file(path, bytes.data(), size);
}

#else

void require_png(const std::string& path) {
  throw Failure(exit_usage, "-o " + path + ": this build writes no pictures",
                "install libpng (Debian: libpng-dev), then configure and build hrad again");
}

void write_png(const Image&, const std::string& path) { require_png(path); }

#endif

}  // namespace hrad::cli
