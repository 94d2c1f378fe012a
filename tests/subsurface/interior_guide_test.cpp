// Guides of dense media, ready to use, from what theory says of a medium.
#include <wend/core/error.h>
#include <wend/subsurface/half_space_modes.h>
#include <wend/subsurface/interior_guide.h>

#include <gtest/gtest.h>

#include <numeric>

namespace wend {
namespace {

const HomogeneousMedium wax{{0.1f, 0.4f, 1}, {4, 3, 2.5f}, Rgb(0.0f), PhaseFunction(HenyeyGreenstein{0.5f})};

TEST(InteriorGuide, SharesAddUpToOne) {
    for (int strategies = 0; strategies <= InteriorGuide::most_strategies; ++strategies) {
        const InteriorGuide guide = interior_guide(wax, half_space_modes(wax), strategies, strategies == 0 ? 1 : 0.4f);
        EXPECT_EQ(guide.channels(), 3);
        EXPECT_EQ(guide.strategies, strategies);
        EXPECT_FLOAT_EQ(guide.share[0], strategies == 0 ? 1 : 0.4f);
        EXPECT_FLOAT_EQ(std::accumulate(guide.share.begin(), guide.share.begin() + 1 + strategies, 0.0f), 1);
    }
}

TEST(InteriorGuide, RefusesWhatMakesNoGuide) {
    const auto modes = half_space_modes(wax);
    EXPECT_THROW(interior_guide(wax, modes, InteriorGuide::most_strategies + 1), InputError);
    EXPECT_THROW(interior_guide(wax, modes, -1), InputError);
    EXPECT_THROW(interior_guide(wax, modes, 1, 0), InputError);
    EXPECT_THROW(interior_guide(wax, modes, 1, 1.5f), InputError);
    EXPECT_THROW(interior_guide(wax, {}, 1), InputError);
    EXPECT_THROW(interior_guide(wax, {modes[0], modes[1]}, 1), InputError);
    EXPECT_THROW(interior_guide(wax, {{modes[0][0]}, modes[1], modes[2]}, 1), InputError);
    EXPECT_THROW(interior_guide(wax, {{}}, 1), InputError);
}

}  // namespace
}  // namespace wend
