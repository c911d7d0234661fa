// Makes the picture of a solution (picture.h). CLI: public headers only.
#include "render/picture.h"

#include <functional>
#include <memory>

#include "render/legend.h"
#include "render/mesh_lines.h"
#include "render/raster.h"
#include "render/sample_values.h"
#include "render/tone_map.h"
#include "render/view_choice.h"
#include "signals.h"

namespace hrad::cli {
namespace {

constexpr size_t most_samples_at_once = size_t{1} << 19;
constexpr int survey_width = 240;

// Behind everything. Screen colours, whatever the exposure.
Colour background() { return {srgb_decoded(52), srgb_decoded(56), srgb_decoded(64)}; }

bool is_outside(const Vector3& point, const Geometry& geometry) {
  bool outside = false;
  for (int axis = 0; axis < 3; ++axis)
    outside = outside || component(point, axis) < component(geometry.lower, axis) ||
              component(point, axis) > component(geometry.upper, axis);
  return outside;
}

double sum_of(const double* values, size_t count) {
  double sum = 0;
  for (size_t k = 0; k < count; ++k) sum += values[k];
  return sum;
}

int rows_at_once(const PictureSize& size, size_t samples_per_pixel) {
  const size_t row = static_cast<size_t>(size.width) * samples_per_pixel;
  return static_cast<int>(std::max<size_t>(1, most_samples_at_once / row));
}

// Sums of the bands over a small picture of the same view, one sample a pixel.
SeenValues survey(Session* session, const Geometry& geometry, const Camera& camera,
                  const PictureSize& size, Backs backs, int32_t quantity) {
  const int width = std::min(survey_width, size.width);
  const PictureSize small{width, std::max(1, width * size.height / size.width)};
  const Raster raster(geometry, camera, small, backs, one_sample(), small.height);
  Visible visible;
  SampleValues values(session, geometry, quantity);
  raster.draw(0, &visible);
  values.fetch(raster, raster.window(0), visible);
  SeenValues seen;
  for (size_t sample = 0; sample < visible.patch.size(); ++sample) {
    const double* bands = values.at(sample);
    if (bands == nullptr) {
      if (visible.patch[sample] != Visible::nothing) seen.black += 1;
      continue;
    }
    const bool emits = geometry.has(visible.patch[sample], Geometry::emitter);
    (emits ? seen.emitting : seen.lit).push_back(sum_of(bands, values.bands()));
  }
  return seen;
}

// Most of what is seen is black by the meaning of sides, or unlit.
bool is_dark(const SeenValues& seen) {
  const auto unlit =
      std::count_if(seen.lit.begin(), seen.lit.end(), [](double v) { return v <= 0; });
  const size_t all = seen.black + seen.lit.size() + seen.emitting.size();
  return 2 * (seen.black + static_cast<size_t>(unlit)) > all;
}

// What lamps show would leave little of the range for everything else.
ColourRange range_of(const SeenValues& seen, const PictureOptions& options) {
  const bool lamps_alone = seen.lit.empty() || options.quantity == HRAD_EMISSION;
  ColourRange range = range_for(lamps_alone ? seen.emitting : seen.lit);
  const double brighter = std::exp2(options.exposure);
  return {range.low / brighter, range.high / brighter};
}

// A line is dark, but light on dark colours.
Colour with_line(const Colour& colour) {
  return luminance(colour) > 0.035 ? mix(colour, {0, 0, 0}, 0.6) : mix(colour, {1, 1, 1}, 0.25);
}

using Painter = std::function<Colour(const double* bands)>;

void paint(Session* session, const Geometry& geometry, const Raster& raster, int rows,
           const PictureOptions& options, const Painter& painter, Image* image) {
  std::unique_ptr<MeshLines> lines;
  if (options.mesh) lines = std::make_unique<MeshLines>(session, raster, rows);
  Visible visible;
  SampleValues values(session, geometry, options.quantity);
  std::vector<uint8_t> on_line;
  for (int number = 0; number < raster.windows(); ++number) {
    signals::check();
    const SampleWindow window = raster.window(number);
    raster.draw(number, &visible);
    values.fetch(raster, window, visible);
    if (lines) lines->draw(number, raster, visible, &on_line);
    const size_t samples_per_pixel = window.places->size();
    size_t sample = 0;
    for (int row = window.first_row; row < window.first_row + window.rows; ++row)
      for (int column = 0; column < window.width; ++column) {
        Colour sum;
        for (size_t k = 0; k < samples_per_pixel; ++k, ++sample) {
          Colour colour;
          if (visible.patch[sample] == Visible::nothing)
            colour = background();
          else if (const double* bands = values.at(sample))
            colour = painter(bands);
          if (lines && on_line[sample]) colour = with_line(colour);
          sum = {sum.red + colour.red, sum.green + colour.green, sum.blue + colour.blue};
        }
        const double share = 1.0 / static_cast<double>(samples_per_pixel);
        image->set(column, row, {share * sum.red, share * sum.green, share * sum.blue});
      }
  }
}

}  // namespace

PictureSize view_size(const PictureOptions& options) {
  const int legend = options.false_colour ? legend_width(options.size.height) : 0;
  return {options.size.width - legend, options.size.height};
}

Picture make_picture(Session* session, const Geometry& geometry, const Camera& camera,
                     const PictureOptions& options) {
  const PictureSize size = view_size(options);
  const Backs backs = is_outside(camera.eye, geometry) ? Backs::hidden : Backs::black;
  const auto bands = static_cast<size_t>(session->bands());
  const SeenValues seen = survey(session, geometry, camera, size, backs, options.quantity);
  Picture picture{
      Image(options.size.width, options.size.height), backs == Backs::hidden, is_dark(seen), 0, {}};
  // The scale is for means of the bands.
  picture.scale =
      ToneMap::scale_for(seen) * static_cast<double>(bands) * std::exp2(options.exposure);
  picture.range = options.range ? *options.range : range_of(seen, options);

  const ToneMap tone_map(picture.scale);
  const FalseColour false_colour(picture.range);
  const Painter painter = [&](const double* values) {
    return options.false_colour ? false_colour(sum_of(values, bands)) : tone_map(values, bands);
  };
  const auto places = sixteen_samples();
  const int rows = rows_at_once(size, places.size());
  const Raster raster(geometry, camera, size, backs, places, rows);
  paint(session, geometry, raster, rows, options, painter, &picture.image);
  if (options.false_colour)
    draw_legend(&picture.image, size.width, legend_title(options.quantity_name, bands),
                false_colour);
  return picture;
}

Image make_automatic_picture(Session* session) {
  const Geometry geometry = fetch_geometry(session);
  const PictureOptions options;
  const int up_axis = find_up_axis(geometry, session->stats().up_axis);
  const Camera camera = choose_camera(geometry, options.size, up_axis, {});
  return make_picture(session, geometry, camera, options).image;
}

}  // namespace hrad::cli
