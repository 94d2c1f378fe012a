#include <wend/app/direction_picture.h>
#include <wend/core/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

constexpr int map_width = DirectionMap::width, map_height = DirectionMap::height;

/// Over all directions.
double integral(const std::vector<float>& map) {
    double sum = 0;
    for (int y = 0; y < map_height; ++y) {
        const double ring = std::cos(pi * y / map_height) - std::cos(pi * (y + 1) / map_height);
        for (int x = 0; x < map_width; ++x) {
            sum += map[static_cast<std::size_t>(y * map_width + x)] * ring * 2 * pi / map_width;
        }
    }
    return sum;
}

std::ptrdiff_t brightest(const std::vector<float>& map) {
    return std::max_element(map.begin(), map.end()) - map.begin();
}

/// Records of a lamp, the directions drawn from it or from all around.
guide::Records lamp_records(const Vmf& lamp, bool uniform) {
    Pcg32 random(1);
    guide::Records records;
    for (int i = 0; i < 20000; ++i) {
        const Vmf from = uniform ? Vmf{} : lamp;
        const Vec3 w = from.sample(random.uniform2());
        records.push_back({Vec3(0, 0, 0), w, 3 * lamp.density(w), from.density(w), 1});
    }
    return records;
}

TEST(DirectionMap, RecordsShowTheRadianceTheyFound) {
    const Vmf lamp{normalize(Vec3(1, 2, 0.5f)), 60};
    const guide::VmfMixture mixture(std::array{guide::WeightedVmf{1, lamp}});
    const std::vector<float> truth = radiance_map(mixture, 3);
    EXPECT_NEAR(integral(truth), 3, 0.01);
    for (const bool uniform : {false, true}) {
        const std::vector<float> map = record_map(lamp_records(lamp, uniform));
        EXPECT_NEAR(integral(map), 3, uniform ? 0.3 : 1e-3);
        const std::ptrdiff_t a = brightest(map), b = brightest(truth);
        EXPECT_LE(std::abs(a % map_width - b % map_width), 16);
        EXPECT_LE(std::abs(a / map_width - b / map_width), 16);
    }
}

TEST(DirectionMap, DarkAndAbsentRecordsAreDark) {
    guide::Records dark = lamp_records({{0, 0, 1}, 5}, true);
    for (guide::Record& record : dark) {
        record.radiance = 0;
    }
    for (const guide::Records& records : {dark, guide::Records()}) {
        const std::vector<float> map = record_map(records);
        EXPECT_EQ(*std::max_element(map.begin(), map.end()), 0);
    }
}

TEST(DirectionMap, PlacesDirectionsByTheAxesThatThePictureNames) {
    EXPECT_EQ(place_on_map({1, 0, 0}), (std::array{map_width / 2, map_height / 2}));
    EXPECT_EQ(place_on_map({0, 1, 0}), (std::array{3 * map_width / 4, map_height / 2}));
    EXPECT_EQ(place_on_map({0, 0, 1})[1], 0);
    EXPECT_EQ(place_on_map({0, 0, -1})[1], map_height - 1);
}

TEST(DirectionMap, AllMapsButTheFirstAreLayers) {
    const guide::VmfMixture mixture(std::array{guide::WeightedVmf{1, Vmf{{0, 0, 1}, 5}}});
    const DirectionMap lobes{"lobes", radiance_map(mixture, 1)};
    EXPECT_TRUE(numbers_picture({lobes}).layers.empty());
    const DirectionMap records{"records", record_map(lamp_records({{0, 0, 1}, 5}, true))};
    const Picture both = numbers_picture({lobes, records});
    ASSERT_EQ(both.layers.size(), 1u);
    EXPECT_EQ(both.layers[0].values, records.values);
    EXPECT_EQ(both.image.pixels[0].r, lobes.values[0]);
}

/// Whether a part of the picture has anything but its corner's colour.
bool has_ink(const Image& image, int x0, int x1, int y0, int y1) {
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
            if (image.at(x, y) != image.at(0, image.height - 1)) {
                return true;
            }
        }
    }
    return false;
}

TEST(DirectionPicture, FramesEachMapWithAxesAndColours) {
    const guide::VmfMixture mixture(std::array{guide::WeightedVmf{1, Vmf{{0, 0, 1}, 5}}});
    const DirectionPanel panel{"at 0,0,0", radiance_map(mixture, 1), {{0, 0, 1}}};
    const ColourScale scale = scale_of({panel});
    EXPECT_NEAR(scale.high / scale.low, 1e4, 1);
    const Image one = labelled_picture({panel}, scale).image;
    EXPECT_EQ(labelled_picture({panel, panel}, scale).image.height, 2 * one.height);
    EXPECT_GT(one.width, map_width);
    EXPECT_GT(one.height, map_height);
    const int left = (one.width - map_width) / 4;
    EXPECT_TRUE(has_ink(one, 0, left, 0, one.height)) << "the angles from +z";
    EXPECT_TRUE(has_ink(one, one.width - left, one.width, 0, one.height)) << "the radiances";
    EXPECT_TRUE(has_ink(one, 0, one.width, 0, 20)) << "the title";
    EXPECT_TRUE(has_ink(one, 0, one.width, one.height - 20, one.height)) << "the longitude";
    const DirectionPanel untitled{"", panel.values, {}};
    EXPECT_FALSE(has_ink(labelled_picture({untitled}, scale).image, 0, map_width / 2, 0, 20));
}

TEST(DirectionPicture, TitlesOfAnyBytesAreDrawn) {
    const guide::VmfMixture mixture(std::array{guide::WeightedVmf{1, Vmf{{0, 0, 1}, 5}}});
    const DirectionPanel panel{"\xff\x01\n~ä" + std::string(400, 'W'), radiance_map(mixture, 1), {}};
    const Image image = labelled_picture({panel}, scale_of({panel})).image;
    EXPECT_TRUE(has_ink(image, 0, image.width, 0, 20));
}

}  // namespace
}  // namespace wend
