#include <wend/app/direction_map.h>
#include <wend/core/vector.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wend {
namespace {

constexpr int width = DirectionMap::width, height = DirectionMap::height;

Vec3 direction_at(int x, int y) {
    const float theta = pi * (static_cast<float>(y) + 0.5f) / height;
    const float phi = 2 * pi * ((static_cast<float>(x) + 0.5f) / width - 0.5f);
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

}  // namespace

std::array<int, 2> place_on_map(const Vec3& w) {
    const float x = (std::atan2(w.y, w.x) / (2 * pi) + 0.5f) * width;
    const float y = std::acos(std::clamp(w.z, -1.0f, 1.0f)) / pi * height;
    return {std::clamp(static_cast<int>(x), 0, width - 1), std::clamp(static_cast<int>(y), 0, height - 1)};
}

std::vector<float> radiance_map(const guide::VmfMixture& incident, float fluence) {
    std::vector<float> map;
    map.reserve(static_cast<std::size_t>(width) * height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            map.push_back(fluence * incident.density(direction_at(x, y)));
        }
    }
    return map;
}

std::vector<float> record_map(const guide::Records& records) {
    constexpr int side = 8;  // of a bin, in places of the map
    constexpr int columns = width / side, rows = height / side;
    std::vector<double> sums(static_cast<std::size_t>(columns) * rows);
    for (const guide::Record& record : records) {
        const auto [x, y] = place_on_map(record.direction);
        sums[static_cast<std::size_t>(y / side * columns + x / side)] += guide::weight_of(record);
    }
    std::vector<float> map;
    map.reserve(static_cast<std::size_t>(width) * height);
    for (int y = 0; y < height; ++y) {
        const int row = y / side;
        const double solid_angle =
            2.0 * pi / columns * (std::cos(double{pi} * row / rows) - std::cos(double{pi} * (row + 1) / rows));
        const double scale = 1 / (solid_angle * static_cast<double>(std::max<std::size_t>(records.size(), 1)));
        for (int x = 0; x < width; ++x) {
            map.push_back(static_cast<float>(sums[static_cast<std::size_t>(row * columns + x / side)] * scale));
        }
    }
    return map;
}

Picture numbers_picture(const std::vector<DirectionMap>& maps) {
    Picture picture;
    picture.full_size = {width, height};
    picture.image = Image(width, height);
    std::transform(maps[0].values.begin(), maps[0].values.end(), picture.image.pixels.begin(),
                   [](float radiance) { return Rgb(radiance); });
    for (std::size_t i = 1; i < maps.size(); ++i) {
        picture.layers.push_back({maps[i].name, {"Y"}, maps[i].values});
    }
    return picture;
}

}  // namespace wend
