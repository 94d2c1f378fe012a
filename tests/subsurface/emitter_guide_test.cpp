// Lamps outside of a medium, as walks inside expect their light.
#include <wend/subsurface/interior_walk.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace wend {
namespace {

TEST(EmitterGuide, LightFallsOffOnTheWayInAndIsSeenWithinItsLobe) {
    const Vmf lobe{normalize(Vec3(0.3f, 0.2f, 0.9f)), 50};
    const std::vector<BoundaryEmitter> lamps = {{lobe, 0.8f, 3, vmf_peak(lobe.kappa)}};
    const Rgb extinction(1, 2, 4);
    const EmitterGuide guide({lamps, 0.5f, Rgb(0.1f)}, extinction, 3);
    ASSERT_EQ(guide.size(), 1u);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(guide.fluence(c, 0), 3 * std::exp(-extinction[c] * 0.5f / 0.8f), 1e-5f);
    }
    for (const Vec3& w : {lobe.mean, normalize(Vec3(0.5f, 0.2f, 0.8f)), Vec3(0, 0, -1)}) {
        EXPECT_NEAR(guide.densities(w)[0], lobe.density(w), 1e-4f * lobe.density(lobe.mean));
    }
    const PhaseFunction phase(HenyeyGreenstein{0.7f});
    EXPECT_FLOAT_EQ(guide.phases(phase, {1, 0, 0})[0], phase.evaluate(lobe.mean.x));
}

TEST(EmitterGuide, SomethingIsAlwaysExpected) {
    EXPECT_GT(EmitterGuide({{}, 1e6f, Rgb(0.0f)}, Rgb(1.0f), 3).diffuse().g, 0);
}

}  // namespace
}  // namespace wend
