#include <wend/app/direction_map.h>
#include <wend/core/vector.h>
#include <wend/film/false_colour.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wend {
namespace {

constexpr int width = DirectionMaps::width, height = DirectionMaps::height;

Vec3 direction_at(int x, int y) {
    const float theta = pi * (static_cast<float>(y) + 0.5f) / height;
    const float phi = 2 * pi * ((static_cast<float>(x) + 0.5f) / width - 0.5f);
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

std::array<int, 2> place_of(const Vec3& w) {
    const float x = (std::atan2(w.y, w.x) / (2 * pi) + 0.5f) * width;
    const float y = std::acos(std::clamp(w.z, -1.0f, 1.0f)) / pi * height;
    return {std::clamp(static_cast<int>(x), 0, width - 1), std::clamp(static_cast<int>(y), 0, height - 1)};
}

}  // namespace

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
        const auto [x, y] = place_of(record.direction);
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

Picture numbers_picture(const DirectionMaps& maps) {
    Picture picture;
    picture.full_size = {width, height};
    picture.image = Image(width, height);
    std::transform(maps.radiance.begin(), maps.radiance.end(), picture.image.pixels.begin(),
                   [](float radiance) { return Rgb(radiance); });
    if (!maps.records.empty()) {
        picture.layers = {{"records", {"Y"}, maps.records}};
    }
    return picture;
}

Picture colours_picture(const DirectionMaps& maps, const guide::VmfMixture& incident) {
    const float largest = std::max(*std::max_element(maps.radiance.begin(), maps.radiance.end()), 1e-30f);
    std::vector<float> values = maps.radiance;
    values.insert(values.end(), maps.records.begin(), maps.records.end());
    const int rows = static_cast<int>(values.size()) / width;
    Picture picture;
    picture.full_size = {width, rows};
    picture.image = false_colour(values, width, rows, {ColourScale::Kind::logarithmic, largest * 1e-4f, largest});
    for (int i = 0; i < incident.size(); ++i) {
        const auto [x, y] = place_of(incident.lobe(i).vmf.mean);
        for (int d = -3; d <= 3; ++d) {
            picture.image.at((x + d + width) % width, y) = Rgb(1.0f);
            picture.image.at(x, std::clamp(y + d, 0, height - 1)) = Rgb(1.0f);
        }
    }
    return picture;
}

}  // namespace wend
