// Guides of dense media, ready to use, from what theory says of a medium.
#include <wend/core/error.h>
#include <wend/subsurface/half_space_mode.h>
#include <wend/subsurface/interior_walk.h>

#include <gtest/gtest.h>

namespace wend {
namespace {

const HomogeneousMedium wax{{0.1f, 0.4f, 1}, {4, 3, 2.5f}, Rgb(0.0f), PhaseFunction(HenyeyGreenstein{0.5f})};

TEST(InteriorGuide, IsThatOfItsMedium) {
    const InteriorGuide guide = interior_guide(wax, half_space_modes(wax), 0.4f);
    EXPECT_EQ(guide.channels(), 3);
    EXPECT_EQ(guide.defensive_fraction, 0.4f);
    EXPECT_EQ(guide.medium.extinction(), wax.extinction());
}

TEST(InteriorGuide, RefusesWhatMakesNoGuide) {
    const auto modes = half_space_modes(wax);
    EXPECT_THROW(interior_guide(wax, modes, 0), InputError);
    EXPECT_THROW(interior_guide(wax, modes, 1.5f), InputError);
    EXPECT_THROW(interior_guide(wax, {}), InputError);
    EXPECT_THROW(interior_guide(wax, {modes[0], modes[1]}), InputError);
    EXPECT_THROW(interior_guide(wax, {{modes[0][0]}, modes[1], modes[2]}), InputError);
    EXPECT_THROW(interior_guide(wax, {{}}), InputError);
}

}  // namespace
}  // namespace wend
