#include <wend/app/raster_text.h>

// It has functions that are not used here, and writes to its arguments, which it does not change.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_easy_font.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <array>
#include <vector>

namespace wend {
namespace {

/// As the font gives them: rectangles of four corners.
struct Corner {
    float x, y, z;
    std::array<unsigned char, 4> colour;
};
using Stroke = std::array<Corner, 4>;

/// What the font has: it looks no character up that it lacks.
std::string printable(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return text;
}

void fill(Image& image, int left, int top, int right, int bottom, const Rgb& colour) {
    for (int y = std::max(0, top); y < std::min(image.height, bottom); ++y) {
        for (int x = std::max(0, left); x < std::min(image.width, right); ++x) {
            image.at(x, y) = colour;
        }
    }
}

}  // namespace

void draw_text(Image& image, int x, int y, const std::string& text, const Rgb& colour, int scale) {
    std::string shown = printable(text);
    // No letter of the font has more strokes.
    std::vector<Stroke> strokes(16 * shown.size());
    const int count = stb_easy_font_print(0, 0, shown.data(), nullptr, strokes.data(),
                                          static_cast<int>(strokes.size() * sizeof(Stroke)));
    for (int i = 0; i < count; ++i) {
        const Stroke& stroke = strokes[static_cast<std::size_t>(i)];
        const auto at = [scale](int origin, float value) { return origin + scale * static_cast<int>(value); };
        fill(image, at(x, stroke[0].x), at(y, stroke[0].y), at(x, stroke[2].x), at(y, stroke[2].y), colour);
    }
}

int text_width(const std::string& text, int scale) {
    std::string shown = printable(text);
    return scale * stb_easy_font_width(shown.data());
}

}  // namespace wend
