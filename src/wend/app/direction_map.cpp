#include <wend/app/direction_map.h>

#include <wend/core/vector.h>
#include <wend/view/direction_bins.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wend {
namespace {

Vec3 direction_at(int x, int y) {
    const float theta = pi * (static_cast<float>(y) + 0.5f) / DirectionMap::height;
    const float phi = 2 * pi * ((static_cast<float>(x) + 0.5f) / DirectionMap::width - 0.5f);
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

}  // namespace

std::array<int, 2> place_on_map(const Vec3& direction) {
    return DirectionBins{DirectionMap::width, DirectionMap::height}.of(direction);
}

std::vector<float> radiance_map(const guide::VmfMixture& incident, float fluence) {
    std::vector<float> map;
    map.reserve(static_cast<std::size_t>(DirectionMap::width) * DirectionMap::height);
    for (int y = 0; y < DirectionMap::height; ++y) {
        for (int x = 0; x < DirectionMap::width; ++x) {
            map.push_back(fluence * incident.density(direction_at(x, y)));
        }
    }
    return map;
}

std::vector<float> record_map(const guide::Records& records) {
    constexpr int side = 8;  // of a bin, in places of the map
    constexpr DirectionBins bins{DirectionMap::width / side, DirectionMap::height / side};
    const std::vector<float> radiance = radiance_by_direction(records, bins);
    std::vector<float> map;
    map.reserve(static_cast<std::size_t>(DirectionMap::width) * DirectionMap::height);
    for (int y = 0; y < DirectionMap::height; ++y) {
        for (int x = 0; x < DirectionMap::width; ++x) {
            map.push_back(radiance[static_cast<std::size_t>(y / side * bins.columns + x / side)]);
        }
    }
    return map;
}

Picture numbers_picture(const std::vector<DirectionMap>& maps) {
    Picture picture;
    picture.full_size = {DirectionMap::width, DirectionMap::height};
    picture.image = Image(DirectionMap::width, DirectionMap::height);
    std::transform(maps[0].values.begin(), maps[0].values.end(), picture.image.pixels.begin(),
                   [](float radiance) { return Rgb(radiance); });
    for (std::size_t i = 1; i < maps.size(); ++i) {
        picture.layers.push_back({maps[i].name, {"Y"}, maps[i].values});
    }
    return picture;
}

}  // namespace wend
