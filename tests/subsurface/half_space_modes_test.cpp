// The modes of a medium: from no decay to its own, by channel, and bounded.
#include <wend/core/error.h>
#include <wend/subsurface/half_space_mode.h>

#include <gtest/gtest.h>

#include <limits>

namespace wend {
namespace {

HomogeneousMedium medium(const Rgb& absorption, const Rgb& scattering, float g) {
    return {absorption, scattering, Rgb(0.0f), PhaseFunction(HenyeyGreenstein{g})};
}

TEST(HalfSpaceModes, GoFromNoDecayToThatOfTheMedium) {
    // Case's eigenvalue at an albedo of 0.8, by the transcendental equation 0.8 atanh(k) = k.
    const auto modes = half_space_modes(medium(Rgb(0.2f), Rgb(0.8f), 0));
    ASSERT_EQ(modes.size(), 1u);
    EXPECT_EQ(modes[0].front().k(), 0);
    EXPECT_NEAR(modes[0].back().k(), 0.7104f, 1e-4f);
    for (std::size_t i = 1; i < modes[0].size(); ++i) {
        EXPECT_GT(modes[0][i].k(), modes[0][i - 1].k());
        EXPECT_NEAR(modes[0][i].k() - modes[0][i - 1].k(), modes[0].back().k() / 8, 0.02f) << i;
    }
}

TEST(HalfSpaceModes, ColouredMediaHaveThemByChannel) {
    const auto modes = half_space_modes(medium({0.01f, 0.1f, 0.3f}, Rgb(1.0f), 0.5f));
    ASSERT_EQ(modes.size(), 3u);
    EXPECT_LT(modes[0].back().k(), modes[1].back().k());
    EXPECT_LT(modes[1].back().k(), modes[2].back().k());
}

TEST(HalfSpaceModes, NeverGoStraightForTheBoundary) {
    for (const float g : {-0.9f, 0.0f, 0.9f, 0.96f}) {
        for (const float scattering : {0.0f, 0.3f, 1.0f}) {
            const auto modes = half_space_modes(medium(Rgb(1.0f), Rgb(scattering), g));
            EXPECT_LE(modes[0].back().contrast(), 41) << "g " << g << " scattering " << scattering;
        }
    }
}

TEST(HalfSpaceModes, NamesWhatIsWrongWithAMedium) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(half_space_modes(medium(Rgb(-0.1f), Rgb(1.0f), 0)), InputError);
    EXPECT_THROW(half_space_modes(medium(Rgb(0.1f), {1, nan, 1}, 0)), InputError);
}

}  // namespace
}  // namespace wend
