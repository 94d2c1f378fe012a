#include "phase_checks.h"

#include <tests/sampling/verdicts.h>
#include <tests/support/chi_square_sphere.h>
#include <wend/core/error.h>
#include <wend/medium/phase.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace wend {
namespace {

struct Named {
    std::string name;
    TabulatedPhase phase;
};

TabulatedPhase coarse() {
    const std::vector<double> cosines = {-1, -0.5, 0, 0.3, 0.8, 1}, values = {2, 0, 1, 0.5, 3, 20};
    return {cosines, values};
}

const std::vector<Named>& all() {
    static const std::vector<Named> phases = {
        {"coarse", coarse()},
        {"fog", fog_droplets(12)},
        {"sea", fournier_forand(1.1, 3.5835)},
        {"hg", tabulate_phase([](double a) {
             return static_cast<double>(HenyeyGreenstein{0.7f}.evaluate(static_cast<float>(std::cos(a))));
         })}};
    return phases;
}

TEST(TabulatedPhase, IntegratesToOneAndHasTheMeanCosine) {
    for (const Named& named : all()) {
        SCOPED_TRACE(named.name);
        const double tolerance = 5e-4;
        EXPECT_NEAR(test::integrate([&](double c) { return named.phase.evaluate(static_cast<float>(c)); }), 1,
                    tolerance);
        EXPECT_NEAR(test::integrate([&](double c) { return c * named.phase.evaluate(static_cast<float>(c)); }),
                    named.phase.mean_cosine(), tolerance);
        EXPECT_FALSE(named.phase.is_isotropic());
        EXPECT_NEAR(named.phase.moment(0), 1, 1e-6);
    }
}

TEST(TabulatedPhase, SamplesFollowTheDensity) {
    // 200,000 samples each, in steps of the angle down to 2 degrees.
    const Vec3 before = normalize(Vec3(-0.4f, 0.7f, -0.2f));
    test::SphereTestOptions options;
    for (const Named& named : all()) {
        ++options.seed;
        const PhaseFunction phase(named.phase);
        const TabulatedPhase& table = named.phase;
        constexpr int samples = 200000, bins = 60, finest = 6;
        const auto bin = [&](float cosine) {
            const float angle = std::sqrt(std::acos(std::clamp(cosine, -1.0f, 1.0f)) * inv_pi);
            return static_cast<std::size_t>(std::clamp(static_cast<int>(angle * bins), finest, bins - 1));
        };
        std::vector<double> observed(bins, 0), expected(bins, 0);
        Pcg32 random(options.seed);
        for (int i = 0; i < samples; ++i) {
            ++observed[bin(dot(before, phase.sample(before, random.uniform2())))];
        }
        constexpr int steps = 400000;
        for (int i = 0; i < steps; ++i) {
            const double a = static_cast<double>(pi) * sqr((i + 0.5) / steps);
            const double width = 2 * static_cast<double>(pi) * (i + 0.5) / sqr(static_cast<double>(steps));
            const auto c = static_cast<float>(std::cos(a));
            expected[bin(c)] += samples * 2 * static_cast<double>(pi) * std::sin(a) * width * table.evaluate(c);
        }
        double chi = 0;
        int used = 0;
        for (std::size_t i = 0; i < bins; ++i) {
            if (expected[i] > 20) {
                chi += sqr(observed[i] - expected[i]) / expected[i];
                ++used;
            }
        }
        EXPECT_LT(chi, used + 5 * std::sqrt(2.0 * used)) << named.name << ' ' << used;
        EXPECT_GT(used, 20) << named.name;
    }
}

TEST(TabulatedPhase, AnotherTableIsRejected) {
    test::SphereTestOptions options;
    options.azimuth_cells = 1;
    const PhaseFunction phase(coarse());
    const std::vector<double> cosines = {-1, -0.5, 0, 0.3, 0.8, 1}, values = {2, 0, 1.1, 0.5, 3, 20};
    const TabulatedPhase wrong(cosines, values);
    const auto test = test::chi_square_sphere(
        [&](Vec2 u) {
            return phase.sample({0, 0, 1}, u);
        },
        [&](const Vec3& w) { return wrong.evaluate(w.z); }, options);
    EXPECT_LT(test.result.p_value, test::failing);
}

TEST(TabulatedPhase, ATableOfAKnownFunctionIsThatFunction) {
    const HenyeyGreenstein exact{0.7f};
    const TabulatedPhase& table = all().back().phase;
    for (const float c : {-1.0f, -0.3f, 0.2f, 0.9f, 0.999f}) {
        EXPECT_NEAR(table.evaluate(c), exact.evaluate(c), 2e-3f * exact.evaluate(c)) << c;
    }
    for (const int l : {1, 2, 5, 20}) {
        EXPECT_NEAR(table.moment(l), exact.moment(l), 1e-3) << l;
    }
    for (const float u : {0.01f, 0.3f, 0.9f}) {
        EXPECT_NEAR(table.sample_cosine(u), exact.sample_cosine(u), 2e-3f);
    }
}

TEST(TabulatedPhase, FournierAndForandScatterAsTheSeaDoes) {
    // In closed form (fournier1999), the share that is scattered backwards.
    const TabulatedPhase sea = fournier_forand(1.1, 3.5835);
    const double back = test::integrate([&](double c) { return c < 0 ? sea.evaluate(static_cast<float>(c)) : 0.0f; });
    EXPECT_NEAR(back, 0.01834, 0.0001);
    EXPECT_GT(sea.mean_cosine(), 0.9f);
    EXPECT_THROW(fournier_forand(1, 3.5), InputError);
    EXPECT_THROW(fournier_forand(1.1, 5), InputError);
}

TEST(TabulatedPhase, FogHasAMixturesMean) {
    for (const double diameter : {5.0, 20.0, 50.0}) {
        const TabulatedPhase fog = fog_droplets(diameter);
        EXPECT_GT(fog.mean_cosine(), 0.7f);
        EXPECT_LT(fog.mean_cosine(), 0.9f);
    }
    EXPECT_THROW(fog_droplets(4.9), InputError);
    EXPECT_THROW(fog_droplets(std::numeric_limits<double>::quiet_NaN()), InputError);
}

TEST(TabulatedPhase, LobesArePictures) {
    for (const Named& named : all()) {
        const AxialLobes lobes = named.phase.lobes();
        // The share of light that both have in common.
        const double common = test::integrate([&](double c) {
            const auto cosine = static_cast<float>(c);
            return std::min(lobes.density(direction_from_cosine(cosine, 0)), named.phase.evaluate(cosine));
        });
        EXPECT_GT(common, named.name == "coarse" ? 0.8 : 0.9) << named.name;
    }
}

TEST(TabulatedPhase, BlurredIsTheConvolution) {
    test::expect_convolved(all().back().phase);
    test::expect_convolved(coarse());
}

TEST(TabulatedPhase, RefusesWhatIsNoTable) {
    using List = std::vector<double>;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refused = [](const List& cosines, const List& values) {
        EXPECT_THROW(TabulatedPhase(cosines, values), InputError);
    };
    refused({}, {});
    refused({-1, 1}, {1});
    refused({-1, 1}, {0, 0});
    refused({-1, 1}, {1, -1});
    refused({-1, 1}, {1, nan});
    refused({-1, 0.5}, {1, 1});
    refused({-1, 0.5, 0.2, 1}, {1, 1, 1, 1});
    EXPECT_TRUE(TabulatedPhase(List{-1, 1}, List{3, 3}).is_isotropic());
}

}  // namespace
}  // namespace wend
