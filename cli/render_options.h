// The options of `hrad render` that say what the picture shows. CLI: public headers only.
#pragma once

#include <optional>
#include <string>

#include "arguments.h"
#include "render/picture.h"

namespace hrad::cli {

class RenderOptions {
 public:
  void add_to(Arguments* arguments);
  // Reads the options: Failure (usage). Call after parsing.
  void check();

  const PictureOptions& picture() const { return picture_; }
  // What was not asked for is chosen. Failure (usage) when a camera asked for sees nothing.
  Camera camera(const Geometry& geometry, int32_t up) const;

 private:
  void check_camera();
  void check_colours();

  std::optional<std::string> size_text_, eye_text_, look_text_, up_text_, fov_text_, exposure_text_,
      quantity_text_, range_text_;
  std::optional<Vector3> eye_, look_, up_;
  std::optional<double> fov_;
  PictureOptions picture_;
};

}  // namespace hrad::cli
