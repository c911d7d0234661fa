// A grid of sensors as a picture (grid_picture.h). CLI: public headers only.
#include "render/grid_picture.h"

#include "arguments.h"
#include "numbers.h"
#include "render/legend.h"

namespace hrad::cli {
namespace {

constexpr double usual_side = 800, largest_side = 16384;  // pixels of the longer side
constexpr int least_height = 240;                         // room for the legend

// Pixels that the cells take: at least one each.
PictureSize cells_size(const SensorGrid& grid) {
  const double scale = std::max({usual_side / std::max(grid.extent[0], grid.extent[1]),
                                 static_cast<double>(grid.cells[0]) / grid.extent[0],
                                 static_cast<double>(grid.cells[1]) / grid.extent[1]});
  const auto side = [&](double extent) {
    return static_cast<int>(std::min(largest_side + 1, std::max(1.0, std::round(extent * scale))));
  };
  return {side(grid.extent[0]), side(grid.extent[1])};
}

}  // namespace

void check_grid_for_picture(const SensorGrid& grid) {
  const PictureSize size = cells_size(grid);
  if (size.width > largest_side || size.height > largest_side)
    fail_usage("query", "a picture of this grid would be more than " +
                            std::to_string(static_cast<int>(largest_side)) +
                            " pixels wide or high: take fewer cells, or cells less long");
}

Image make_grid_picture(const SensorGrid& grid, const std::vector<double>& values, size_t bands) {
  const PictureSize size = cells_size(grid);
  const int height = std::max(size.height, least_height);
  Image image(size.width + legend_width(height), height);
  image.fill(0, 0, size.width, height, grey(24));
  const FalseColour colours(range_for(values));
  const int top = (height - size.height) / 2;
  for (int row = 0; row < size.height; ++row)
    for (int column = 0; column < size.width; ++column) {
      const int64_t i = column * grid.cells[0] / size.width;
      const int64_t j = (size.height - 1 - row) * grid.cells[1] / size.height;
      image.set(column, top + row, colours(values[static_cast<size_t>(j * grid.cells[0] + i)]));
    }
  std::vector<std::string> title = legend_title("irradiance", bands);
  title.push_back(std::string(1, grid.normal_axis) + " = " + short_text(grid.level, 4));
  draw_legend(&image, size.width, title, colours);
  return image;
}

}  // namespace hrad::cli
