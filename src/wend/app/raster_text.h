#pragma once

#include <wend/core/image.h>

#include <string>

namespace wend {

/// Text made of pixels, for labels in pictures that have nothing else: ASCII (others show as '?'), capitals 7 pixels
/// high, times a whole `scale`. The upper left corner is at (x, y); what lies outside of the image is left out.
void draw_text(Image& image, int x, int y, const std::string& text, const Rgb& colour, int scale = 1);

/// How wide it is, in pixels.
int text_width(const std::string& text, int scale = 1);

}  // namespace wend
