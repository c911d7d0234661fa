// The legend of a false-colour picture (legend.h). CLI: public headers only.
#include "render/legend.h"

#include "numbers.h"
#include "render/bitmap_font.h"

namespace hrad::cli {
namespace {

// In letters' pixels.
constexpr int margin = 8, bar_width = 14, tick_length = 3, columns = 76;

int scale_for(int height) { return std::max(1, static_cast<int>(std::lround(height / 480.0))); }

}  // namespace

int legend_width(int height) { return columns * scale_for(height); }

std::vector<std::string> legend_title(const std::string& quantity, size_t bands) {
  std::vector<std::string> lines{quantity, "W/m\xb2"};
  if (bands > 1) {
    lines.push_back("sum of");
    lines.push_back(std::to_string(bands) + " bands");
  }
  return lines;
}

void draw_legend(Image* image, int left, const std::vector<std::string>& title,
                 const FalseColour& colours) {
  const int scale = scale_for(image->height);
  const Colour paper = grey(24), ink = grey(225);
  image->fill(left, 0, image->width, image->height, paper);
  int top = margin * scale;
  for (const std::string& line : title) {
    draw_text(image, left + margin * scale, top, scale, line, ink);
    top += line_height * scale;
  }
  top += line_height * scale / 2;
  const int bottom = image->height - margin * scale;
  const int bar_left = left + margin * scale, bar_right = bar_left + bar_width * scale;
  const ColourRange& range = colours.range();
  const double step = (range.high - range.low) / std::max(1, bottom - top - 1);
  for (int row = top; row < bottom; ++row)
    image->fill(bar_left, row, bar_right, row + 1, colours(range.low + step * (bottom - 1 - row)));
  const int letters = letter_height * scale;
  for (double value : tick_values(range, (bottom - top) / (4 * letters))) {
    const int row = bottom - 1 - static_cast<int>(std::lround((value - range.low) / step));
    const int tick_top = std::max(top, std::min(bottom - scale, row - scale / 2));
    image->fill(bar_right, tick_top, bar_right + tick_length * scale, tick_top + scale, ink);
    const int text_top = std::max(top, std::min(bottom - letters, row - letters / 2));
    draw_text(image, bar_right + (tick_length + 3) * scale, text_top, scale, short_text(value, 4),
              ink);
  }
}

}  // namespace hrad::cli
