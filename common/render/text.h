// SPDX-License-Identifier: MIT
//
// Short captions and region numbers, in a stroke font of our own: letters are polylines drawn with a round
// pen, so they are smooth at any size and need no font file. ASCII; anything else shows as '?'.
#pragma once

#include <string_view>

#include "common/render/image.h"

namespace selvage {

struct TextStyle {
  double height_px = 14;  ///< of a capital letter
  double pen_px = 0;      ///< stroke width; 0 is a seventh of the height
  double halo_px = 0;     ///< a rim around the strokes, so that text reads on any ground
  Rgb colour = kBlack;
  Rgb halo_colour = kWhite;
};

double text_width_px(std::string_view text, const TextStyle& style);

/// Draws one line of text with the left end of its baseline at (x, y). What lies outside is cut off.
void draw_text(Image& image, double x, double y, std::string_view text, const TextStyle& style);

/// Draws one line of text with its middle at (x, y).
void draw_text_centred(Image& image, double x, double y, std::string_view text, const TextStyle& style);

}  // namespace selvage
