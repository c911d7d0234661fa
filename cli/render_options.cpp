// What a picture shows (render_options.h). CLI: public headers only.
#include "render_options.h"

#include "numbers.h"
#include "quantity.h"
#include "render/legend.h"
#include "render/view_choice.h"

namespace hrad::cli {
namespace {

constexpr int64_t largest_side = 16384;
constexpr double largest_exposure = 64;

void fail(const std::string& message) { fail_usage("render", message); }

void read_point(const char* option, const std::optional<std::string>& text,
                std::optional<Vector3>* value) {
  if (!text) return;
  std::array<double, 3> numbers{};
  if (!read_vector(*text, &numbers))
    fail(std::string(option) + " takes X,Y,Z, not '" + *text + "'");
  *value = Vector3{numbers[0], numbers[1], numbers[2]};
}

double read_within(const char* option, const std::string& text, double low, double high) {
  double value = 0;
  if (!read_real(text, &value) || value < low || value > high)
    fail(std::string(option) + " takes a number from " + short_text(low, 6) + " to " +
         short_text(high, 6) + ", not '" + text + "'");
  return value;
}

PictureSize read_size(const std::string& text) {
  const auto parts = split(text, 'x');
  int64_t width = 0, height = 0;
  if (parts.size() != 2 || !read_integer(parts[0], &width) || !read_integer(parts[1], &height) ||
      width < 1 || height < 1 || width > largest_side || height > largest_side)
    fail("--size takes WxH, both from 1 to " + std::to_string(largest_side) + ", not '" + text +
         "'");
  return {static_cast<int>(width), static_cast<int>(height)};
}

ColourRange read_range(const std::string& text) {
  const auto parts = split(text, ':');
  ColourRange range;
  if (parts.size() != 2 || !read_real(parts[0], &range.low) || !read_real(parts[1], &range.high) ||
      !(range.low < range.high))
    fail("--range takes LOW:HIGH, two numbers in this order, not '" + text + "'");
  return range;
}

}  // namespace

void RenderOptions::add_to(Arguments* arguments) {
  arguments->add_option("--size", "WxH", &size_text_, "Pixels of the picture (960x720)");
  arguments->add_option("--eye", "X,Y,Z", &eye_text_, "Where the camera stands");
  arguments->add_option("--look", "X,Y,Z", &look_text_,
                        "The point in the middle of the picture (the scene's middle)");
  arguments->add_option("--up", "X,Y,Z", &up_text_, "The direction that is up in the picture");
  arguments->add_option("--fov", "DEG", &fov_text_,
                        "Field of view from the picture's lower to its upper edge");
  arguments->add_option("--exposure", "EV", &exposure_text_,
                        "Stops brighter than automatic: 1 is twice the light, -1 half of it");
  arguments->add_flag("--false-colour", &picture_.false_colour,
                      "Colours for numbers, with a legend in W/m2");
  arguments->add_option("--quantity", "Q", &quantity_text_,
                        "Of --false-colour: radiosity (the default), irradiance, emission or "
                        "net_flux");
  arguments->add_option("--range", "LOW:HIGH", &range_text_,
                        "Of --false-colour: the numbers at the ends of the colours");
  arguments->add_flag("--mesh", &picture_.mesh, "Draw the edges of the leaves");
}

void RenderOptions::check() {
  if (size_text_) picture_.size = read_size(*size_text_);
  if (exposure_text_)
    picture_.exposure =
        read_within("--exposure", *exposure_text_, -largest_exposure, largest_exposure);
  check_camera();
  check_colours();
}

void RenderOptions::check_camera() {
  read_point("--eye", eye_text_, &eye_);
  read_point("--look", look_text_, &look_);
  read_point("--up", up_text_, &up_);
  if (fov_text_) fov_ = read_within("--fov", *fov_text_, 0.1, 179);
  if (look_ && !eye_) fail("--look is for a camera whose --eye is given");
  if (up_ && !(length(*up_) > 0)) fail("--up has no length");
  if (eye_ && look_ && !(length(*look_ - *eye_) > 0)) fail("--eye and --look are the same point");
}

void RenderOptions::check_colours() {
  if (!picture_.false_colour && (quantity_text_ || range_text_))
    fail("--quantity and --range are for --false-colour");
  if (range_text_ && exposure_text_) fail("--range and --exposure exclude each other");
  if (quantity_text_) {
    const Quantity quantity = read_quantity(*quantity_text_, "render");
    picture_.quantity = quantity.number;
    picture_.quantity_name = quantity.name;
  }
  if (range_text_) picture_.range = read_range(*range_text_);
  const PictureSize& least = least_size_with_legend;
  if (picture_.false_colour && (view_size(picture_).width < least.width - legend_width(0) ||
                                picture_.size.height < least.height))
    fail("--size: the legend of --false-colour needs at least " + std::to_string(least.width) +
         "x" + std::to_string(least.height) + ", and a picture not much higher than wide");
}

Camera RenderOptions::camera(const Geometry& geometry, int32_t up) const {
  const PictureSize size = view_size(picture_);
  int up_axis = find_up_axis(geometry, up);
  if (up_)
    for (int axis = 0; axis < 3; ++axis)
      if (std::fabs(component(*up_, axis)) > std::fabs(component(*up_, up_axis))) up_axis = axis;
  Camera camera;
  if (!eye_) {
    camera = choose_camera(geometry, size, up_axis, fov_);
  } else {
    camera = {*eye_, look_.value_or(geometry.centre()), axis_vector(up_axis), camera.fov};
    if (fov_) camera.fov = *fov_;
    // Straight up and down another axis is up.
    if (!up_ && !has_view(camera)) camera.up = axis_vector((up_axis + 1) % 3);
  }
  if (up_) camera.up = *up_;
  if (!has_view(camera))
    fail(eye_ && length(camera.look - camera.eye) == 0
             ? "--eye is the scene's middle: say where to --look"
             : "the camera looks along its own --up");
  return camera;
}

}  // namespace hrad::cli
