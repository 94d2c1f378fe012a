#include <tests/guide/sphere_integral.h>
#include <wend/core/random.h>
#include <wend/guide/fit.h>
#include <wend/guide/region.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace wend::guide {
namespace {

const Vec3 here(0.5f, 0.5f, 0.5f);
const Vmf red_lamp{Vec3(1, 0, 0), 80}, blue_lamp{Vec3(0, 0, -1), 40};
const Rgb red(3, 0, 0), blue(0.2f, 0.4f, 2.4f);

Rgb truth(const Vec3& w) {
    return red * (0.7f * red_lamp.density(w)) + blue * (0.3f * blue_lamp.density(w));
}

/// A field that has seen both lamps, in passes.
Field learned(bool tells_colours = true) {
    const VmfMixture both(std::array<WeightedVmf, 2>{{{0.7f, red_lamp}, {0.3f, blue_lamp}}});
    FitSettings settings;
    settings.leaf_samples = 1e9;
    Field field = Field::empty(Box3(Vec3(0), Vec3(1)));
    Pcg32 random(1);
    for (int pass = 0; pass < 3; ++pass) {
        Records records;
        for (int i = 0; i < 10000; ++i) {
            const Vec2 u = random.uniform2();
            const Vec3 w = both.sample(random.uniform2());
            Record r{{u.x, u.y, random.uniform()}, w, mean(truth(w)), both.density(w), 1e6f};
            if (tells_colours) {
                r.colour = truth(w) * 1e-3f;
            }
            records.push_back(r);
        }
        field = fit(field, records, settings, 1).field;
    }
    return field;
}

void expect_near(const Rgb& value, const Rgb& expected, float tolerance) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(value[c], expected[c], tolerance) << c;
    }
}

TEST(Colour, EachLobeHasItsOwn) {
    const Field field = learned();
    const Region& region = *field.find(here);
    for (const Vec3& w : {red_lamp.mean, blue_lamp.mean}) {
        expect_near(region.radiance(here, w) / mean(truth(w)), truth(w) / mean(truth(w)), 0.1f);
    }
    // The twin: colours that are not told are grey.
    const Field grey = learned(false);
    expect_near(grey.find(here)->radiance(here, red_lamp.mean) / mean(truth(red_lamp.mean)), Rgb(1), 0.1f);
}

TEST(Colour, InScatteredRadianceIsTheIntegralOfTheTruthByChannel) {
    const Field field = learned();
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 0, -1), normalize(Vec3(1, 1, -1))}) {
        const AxialLobes lobes = AxialLobes(std::array{AxialLobe{1, 3.0f}}).around(axis);
        Rgb expected;
        for (int c = 0; c < 3; ++c) {
            expected[c] = static_cast<float>(test::integrate_sphere(
                [&](const Vec3& w) { return static_cast<double>(truth(w)[c] * lobes.density(w)); }));
        }
        const Rgb found = in_scattered(*field.find(here), here, lobes);
        expect_near(found, expected, 0.05f * mean(expected));
        const MixtureProduct product = field.find(here)->incident(here).product(lobes);
        EXPECT_NEAR(mean(found), field.find(here)->fluence() * product.integral(), 0.01f * mean(expected));
    }
}

TEST(Colour, GreyStaysExactlyGrey) {
    const Field field = learned(false);
    const Region& region = *field.find(here);
    for (int i = 0; i < region.mixture().size(); ++i) {
        EXPECT_EQ(region.colours()[i], Rgb(1));
    }
}

TEST(Colour, RecordsWithImpossibleOnesAreIgnored) {
    Record record{here, {0, 0, 1}, 1, 1, 1};
    EXPECT_TRUE(is_usable(record));
    record.colour = {0, 0, 0};
    EXPECT_TRUE(is_usable(record));
    record.colour = {1, -1, 1};
    EXPECT_FALSE(is_usable(record));
    record.colour = {1, std::numeric_limits<float>::infinity(), 1};
    EXPECT_FALSE(is_usable(record));
}

TEST(BriefFloat, KeepsEightBits) {
    Pcg32 random(1);
    for (int i = 0; i < 10000; ++i) {
        const float value = std::ldexp(random.uniform() - 0.5f, static_cast<int>(random.uniform() * 200) - 100);
        EXPECT_LE(std::abs(BriefFloat(value) - value), std::abs(value) / 256);
        EXPECT_EQ(static_cast<float>(BriefFloat(BriefFloat(value))), static_cast<float>(BriefFloat(value)));
    }
    EXPECT_EQ(static_cast<float>(BriefFloat(1.0f)), 1.0f);
    EXPECT_EQ(static_cast<float>(BriefFloat(-0.375f)), -0.375f);
}

TEST(Field, FitsItsMemory) {
    EXPECT_LE(Field::bytes_per_cell(), 1536u);
}

}  // namespace
}  // namespace wend::guide
