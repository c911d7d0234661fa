// Letters of 5 x 7 pixels, two more below the line, for what is written in pictures. CLI: public
// headers only.
#pragma once

#include <string_view>

#include "render/image.h"

namespace hrad::cli {

constexpr int letter_width = 6, letter_height = 7, line_height = 11;  // with the gaps between them

// Digits, small letters, W, / . - + = and the superscript 2 (Latin-1: "\xb2"); others are blank.
// Every pixel of a letter becomes scale x scale of them, the first one at (left, top).
void draw_text(Image* image, int left, int top, int scale, std::string_view text,
               const Colour& colour);

}  // namespace hrad::cli
