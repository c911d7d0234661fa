// Makes the picture of a solution: samples, their values from the library's linear reconstruction,
// colours. CLI: public headers only.
#pragma once

#include <optional>
#include <string>

#include "render/camera.h"
#include "render/false_colour.h"
#include "render/geometry.h"
#include "render/image.h"
#include "session.h"

namespace hrad::cli {

struct PictureOptions {
  PictureSize size;
  double exposure = 0;  // stops: twice as bright for 1
  bool false_colour = false, mesh = false;
  int32_t quantity = HRAD_RADIOSITY;  // of false colour
  std::string quantity_name = "radiosity";
  std::optional<ColourRange> range;  // of false colour; found from what is seen without it
};

struct Picture {
  Image image;
  bool backs_hidden;  // the backs of one-sided patches were left out
  bool dark;          // most of what is seen is black
  double scale;       // light of the screen per W/m2, when not in false colour
  ColourRange range;  // of false colour
};

// The part of the picture that shows the scene.
PictureSize view_size(const PictureOptions& options);

// Backs are left out when the eye lies outside the scene's box, and black otherwise. Interrupted
// when a signal asks for it.
Picture make_picture(Session* session, const Geometry& geometry, const Camera& camera,
                     const PictureOptions& options);

// With the default options and the automatic camera.
Image make_automatic_picture(Session* session);

}  // namespace hrad::cli
