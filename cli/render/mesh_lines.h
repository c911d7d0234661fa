// The edges of the leaves as thin lines over a picture. CLI: public headers only.
#pragma once

#include <cstdint>
#include <vector>

#include "render/raster.h"
#include "session.h"

namespace hrad::cli {

class MeshLines {
 public:
  // All leaves that the raster's view may show, for windows of `rows` rows as those of the raster.
  MeshLines(Session* session, const Raster& raster, int rows);

  // Per sample of the window: whether it lies on an edge of the leaf that it sees.
  void draw(int number, const Raster& raster, const Visible& visible,
            std::vector<uint8_t>* on_line) const;

 private:
  struct Leaf {
    std::array<Vector3, 3> corners;  // in the pixels' space
    int64_t patch;
    bool front;
  };
  std::vector<Leaf> leaves_;
  WindowBins bins_;
};

}  // namespace hrad::cli
