#include <wend/app/direction_map.h>
#include <wend/core/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

constexpr int width = DirectionMaps::width, height = DirectionMaps::height;

/// Over all directions.
double integral(const std::vector<float>& map) {
    double sum = 0;
    for (int y = 0; y < height; ++y) {
        const double ring = std::cos(pi * y / height) - std::cos(pi * (y + 1) / height);
        for (int x = 0; x < width; ++x) {
            sum += map[static_cast<std::size_t>(y * width + x)] * ring * 2 * pi / width;
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
        EXPECT_LE(std::abs(a % width - b % width), 16);
        EXPECT_LE(std::abs(a / width - b / width), 16);
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

TEST(DirectionMap, RecordsAreBelowTheLobesOrALayer) {
    const guide::VmfMixture mixture(std::array{guide::WeightedVmf{1, Vmf{{0, 0, 1}, 5}}});
    const DirectionMaps alone{radiance_map(mixture, 1), {}};
    EXPECT_EQ(colours_picture(alone, mixture).image.height, height);
    EXPECT_TRUE(numbers_picture(alone).layers.empty());
    const DirectionMaps both{alone.radiance, record_map(lamp_records({{0, 0, 1}, 5}, true))};
    EXPECT_EQ(colours_picture(both, mixture).image.height, 2 * height);
    ASSERT_EQ(numbers_picture(both).layers.size(), 1u);
    EXPECT_EQ(numbers_picture(both).layers[0].values, both.records);
}

}  // namespace
}  // namespace wend
