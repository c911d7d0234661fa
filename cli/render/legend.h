// The legend of a false-colour picture: a bar of its colours with numbers, at the right. CLI:
// public headers only.
#pragma once

#include <string>
#include <vector>

#include "render/camera.h"
#include "render/false_colour.h"

namespace hrad::cli {

// The smallest picture that a legend fits into beside something to look at.
inline constexpr PictureSize least_size_with_legend{160, 120};

// The columns that the legend of a picture of this height takes.
int legend_width(int height);

// What stands above the bar, one string a line.
std::vector<std::string> legend_title(const std::string& quantity, size_t bands);

// Fills the columns from `left` on.
void draw_legend(Image* image, int left, const std::vector<std::string>& title,
                 const FalseColour& colours);

}  // namespace hrad::cli
