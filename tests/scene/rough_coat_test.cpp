#include <tests/sampling/verdicts.h>
#include <wend/scene/bsdf/rough_coat.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

CoatedBsdf coated(float reflectance, float alpha, float thickness) {
    CoatedBsdf b;
    b.coat = {1.5f, alpha, alpha};
    b.base = LambertBsdf{Rgb(reflectance)};
    b.thickness = thickness;
    b.max_depth = 1000;
    return b;
}

/// What comes from below the coat, over the seeds of walks.
Moments from_below(CoatedBsdf b) {
    const Vec3 wo = normalize(Vec3(0.2f, -0.3f, 0.7f)), wi = normalize(Vec3(-0.3f, 0.6f, 0.5f));
    Moments moments;
    // 200,000 walks: a standard error of half a per cent.
    for (b.seed = 0; b.seed < 200000; ++b.seed) {
        moments.add(b.evaluate(wo, wi).r - b.coat.evaluate(wo, wi).r);
    }
    return moments;
}

// A matt base of reflectance c returns c + c² r + c³ r² + ... of what comes to it, r of which is the coat's.
TEST(RoughCoat, ReturnsWhatWalksSay) {
    for (const float alpha : {0.2f, 0.6f}) {
        for (const float thickness : {0.0f, 0.3f}) {
            const Moments white = from_below(coated(1, alpha, thickness));
            const Moments grey = from_below(coated(0.5f, alpha, thickness));
            const auto ratio = [](double r) { return 2 * (1 - 0.5 * r) / (1 - r); };
            const double expected = ratio(rough_coat_return(coated(1, alpha, thickness).coat, thickness));
            EXPECT_TRUE(test::is_within_one_percent(white, expected * grey.mean(), 0.01 * white.mean()))
                << alpha << ", " << thickness << ": " << white.mean() / grey.mean() << ", not " << expected;
        }
    }
    // A smooth coat returns more.
    EXPECT_GT(coat_return(1.5f, 0), rough_coat_return(coated(1, 0.6f, 0).coat, 0) + 0.02f);
}

TEST(RoughCoat, OfASmoothOneIsThatOfFresnel) {
    EXPECT_EQ(rough_coat_return({1.5f, 0, 0}, 0.3f), coat_return(1.5f, 0.3f));
    EXPECT_NEAR(rough_coat_return({1.5f, 0.01f, 0.01f}, 0), coat_return(1.5f, 0), 2e-3f);
}

}  // namespace
}  // namespace wend
