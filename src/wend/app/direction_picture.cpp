#include <wend/app/direction_picture.h>

#include <wend/app/raster_text.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

constexpr int map_width = DirectionMap::width, map_height = DirectionMap::height;
// Around a map, in pixels.
constexpr int left_of_map = 112, right_of_map = 158, above_map = 34, below_map = 72;
constexpr int text_scale = 2, text_height = 14, bar_width = 18;
constexpr Rgb ink(0.85f), quiet(0.35f), ground(0.008f);

struct AxisLabel {
    int at;  ///< degrees
    const char* text;
};

void centre_text(Image& image, int x, int y, const std::string& text, const Rgb& colour) {
    draw_text(image, x - text_width(text, text_scale) / 2, y, text, colour, text_scale);
}

void end_text(Image& image, int x, int y, const std::string& text, const Rgb& colour) {
    draw_text(image, x - text_width(text, text_scale), y, text, colour, text_scale);
}

/// The longitude, below the map at row `y`.
void draw_longitude(Image& image, int y) {
    for (const AxisLabel& label : {AxisLabel{-180, "-x"}, {-90, "-y"}, {0, "+x"}, {90, "+y"}, {180, "-x"}}) {
        const int x = left_of_map + (label.at + 180) * (map_width - 1) / 360;
        for (int i = 0; i < 6; ++i) {
            image.at(x, y + i) = ink;
        }
        centre_text(image, x, y + 10, fmt::format("{}", label.at), ink);
        centre_text(image, x, y + 28, label.text, ink);
    }
    centre_text(image, left_of_map + map_width / 2, y + 50, "longitude in degrees, from +x towards +y", quiet);
}

/// The angle from +z, to the left of the map that begins at row `y`.
void draw_latitude(Image& image, int y) {
    for (const AxisLabel& label : {AxisLabel{0, "+z 0"}, {90, "90"}, {180, "-z 180"}}) {
        const int row = y + label.at * (map_height - 1) / 180;
        for (int i = 1; i <= 6; ++i) {
            image.at(left_of_map - i, row) = ink;
        }
        end_text(image, left_of_map - 10, row - text_height / 2, label.text, ink);
    }
    end_text(image, left_of_map - 10, y + map_height / 4, "angle", quiet);
    end_text(image, left_of_map - 10, y + map_height / 4 + 18, "from +z", quiet);
}

/// The colours and what they stand for, to the right.
void draw_bar(Image& image, int y, const ColourScale& scale) {
    const int x = left_of_map + map_width + 16;
    for (int row = 0; row < map_height; ++row) {
        const Rgb colour = false_colour(1 - static_cast<float>(row) / (map_height - 1));
        for (int i = 0; i < bar_width; ++i) {
            image.at(x + i, y + row) = colour;
        }
    }
    constexpr int decades = 4;
    for (int d = 0; d <= decades; ++d) {
        const float value = scale.high * std::pow(10.0f, static_cast<float>(-d));
        draw_text(image, x + bar_width + 8, y + d * (map_height - 1) / decades - text_height / 2,
                  fmt::format("{:.2g}", value), ink, text_scale);
    }
    draw_text(image, x, y - 24, "radiance", quiet, text_scale);
}

}  // namespace

ColourScale scale_of(const std::vector<DirectionPanel>& panels) {
    float largest = 1e-30f;
    for (const DirectionPanel& panel : panels) {
        largest = std::max(largest, *std::max_element(panel.values.begin(), panel.values.end()));
    }
    return {ColourScale::Kind::logarithmic, largest * 1e-4f, largest};
}

Image map_image(const DirectionPanel& panel, const ColourScale& scale) {
    Image image = false_colour(panel.values, map_width, map_height, scale);
    for (const Vec3& mark : panel.marks) {
        const auto [x, y] = place_on_map(mark);
        for (int d = -3; d <= 3; ++d) {
            image.at((x + d + map_width) % map_width, y) = Rgb(1.0f);
            image.at(x, std::clamp(y + d, 0, map_height - 1)) = Rgb(1.0f);
        }
    }
    return image;
}

Picture labelled_picture(const std::vector<DirectionPanel>& panels, const ColourScale& scale) {
    constexpr int panel_height = above_map + map_height + below_map;
    Picture picture;
    picture.full_size = {left_of_map + map_width + right_of_map, panel_height * static_cast<int>(panels.size())};
    picture.image = Image(picture.full_size.x, picture.full_size.y, ground);
    int y = 0;
    for (const DirectionPanel& panel : panels) {
        const Image map = map_image(panel, scale);
        for (int row = 0; row < map_height; ++row) {
            for (int x = 0; x < map_width; ++x) {
                picture.image.at(left_of_map + x, y + above_map + row) = map.at(x, row);
            }
        }
        draw_text(picture.image, left_of_map, y + 10, panel.title, ink, text_scale);
        draw_longitude(picture.image, y + above_map + map_height);
        draw_latitude(picture.image, y + above_map);
        draw_bar(picture.image, y + above_map, scale);
        y += panel_height;
    }
    return picture;
}

}  // namespace wend
