// Which lights have beams, and what is expected of the others.
#include <wend/light/beams.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace wend {
namespace {

constexpr float radius = 3;

SpotLight spot(float cosine, float intensity) {
    SpotLight light;
    light.intensity = Rgb(intensity);
    light.cos_inner = light.cos_outer = cosine;
    return light;
}

TEST(Beams, AreThoseOfNarrowLamps) {
    const std::vector<Light> lights{spot(0.9f, 2), spot(0.4f, 2), PointLight{Vec3(0), Rgb(1)}};
    const auto beams = beams_of(lights, radius);
    ASSERT_EQ(beams.size(), 1);
    EXPECT_EQ(beams[0].cosine, 0.9f);
    EXPECT_FLOAT_EQ(beams[0].intensity, 2);
}

TEST(Beams, ExpectTheRadianceOfASkyAsItIs) {
    const std::vector<Light> lights{spot(0.9f, 2), UniformInfiniteLight{Rgb(0.7f)}};
    // Fluence 4 pi L, of which the phase function scatters 1 / 4 pi into a direction.
    EXPECT_NEAR(beams_of(lights, radius)[0].others, 0.7f, 1e-6f);
}

TEST(Beams, ExpectNothingOfOthersWhereThereAreNone) {
    EXPECT_EQ(beams_of(std::vector<Light>{spot(0.9f, 2)}, radius)[0].others, 0);
    EXPECT_EQ(beams_of(std::vector<Light>{spot(0.9f, 2)}, 0)[0].others, 0);
}

TEST(Beams, OneIsOfTheOthersOfAnother) {
    const auto beams = beams_of(std::vector<Light>{spot(0.9f, 2), spot(0.95f, 5)}, radius);
    const float squared = radius * radius, cone = 2 * pi * (1 - 0.95f);
    EXPECT_NEAR(beams[0].others, 5 * cone / (4 * pi * pi * squared), 1e-6f);
}

}  // namespace
}  // namespace wend
