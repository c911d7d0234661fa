// Fuzz target: any bytes as an MTL file. Reading ends with materials whose values the solver takes,
// or with a typed error that names the file.
#include <cstdlib>
#include <string>

#include "base/error.h"
#include "fuzz/target.h"
#include "scene/mtl_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  hrad::MtlLibrary library;
  try {
    hrad::read_mtl("fuzz.mtl", std::string_view(reinterpret_cast<const char*>(data), size),
                   library);
  } catch (const hrad::Error& error) {
    if (error.status() != hrad::Status::scene || std::string(error.what()).rfind("fuzz.mtl:", 0))
      std::abort();
  }
  for (const hrad::MtlMaterial& m : library.materials)
    for (int band = 0; band < 3; ++band)
      if (!(m.reflectance[band] >= 0 && m.reflectance[band] < 1 && m.emission[band] >= 0 &&
            m.emission[band] <= 1e30))
        std::abort();
  return 0;
}
