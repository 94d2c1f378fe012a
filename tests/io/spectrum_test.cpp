#include <tests/io/near.h>
#include <wend/core/error.h>
#include <wend/core/vector.h>
#include <wend/io/spectrum/blackbody.h>
#include <wend/io/spectrum/colorimetry.h>
#include <wend/io/spectrum/medium_presets.h>
#include <wend/io/spectrum/named_spectra.h>
#include <wend/io/spectrum/white_balance.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace wend {
namespace {

using test::expect_near;

struct Chromaticity {
    double x, y;
};

Chromaticity chromaticity(const Rgb& rgb) {
    const double x = 0.4124564 * rgb.r + 0.3575761 * rgb.g + 0.1804375 * rgb.b;
    const double y = 0.2126729 * rgb.r + 0.7151522 * rgb.g + 0.0721750 * rgb.b;
    const double z = 0.0193339 * rgb.r + 0.1191920 * rgb.g + 0.9503041 * rgb.b;
    return {x / (x + y + z), y / (x + y + z)};
}

Rgb normal_reflectance(const Rgb& eta, const Rgb& k) {
    Rgb r;
    for (int c = 0; c < 3; ++c) {
        r[c] = (sqr(eta[c] - 1) + sqr(k[c])) / (sqr(eta[c] + 1) + sqr(k[c]));
    }
    return r;
}

TEST(Spectrum, ConstantsMapToConstants) {
    for (const float v : {0.0f, 0.2f, 1.0f}) {
        const std::vector<SpectrumSample> constant{{200, v}, {900, v}};
        expect_near(rgb_from_pairs(constant, SpectrumKind::reflectance), Rgb(v), 1e-5f);
        expect_near(rgb_from_pairs(constant, SpectrumKind::unbounded), Rgb(v), 1e-5f);
    }
    const std::vector<SpectrumSample> large{{300, 70}, {550, 70}, {900, 70}};
    expect_near(rgb_from_pairs(large, SpectrumKind::unbounded), Rgb(70), 1e-3f);
}

TEST(Spectrum, ColoursOfReflectancesAreTheirs) {
    const Rgb red =
        rgb_from_pairs(std::vector<SpectrumSample>{{590, 0}, {600, 1}, {830, 1}}, SpectrumKind::reflectance);
    EXPECT_GT(red.r, 0.7f);
    EXPECT_LT(red.g, 0.1f);
    EXPECT_LT(red.b, 0.1f);
    const Rgb blue =
        rgb_from_pairs(std::vector<SpectrumSample>{{360, 1}, {480, 1}, {490, 0}}, SpectrumKind::reflectance);
    EXPECT_GT(blue.b, 0.7f);
    EXPECT_LT(blue.r, 0.2f);
    const Rgb green =
        rgb_from_pairs(std::vector<SpectrumSample>{{500, 0}, {510, 1}, {570, 1}, {580, 0}}, SpectrumKind::reflectance);
    EXPECT_GT(green.g, 2 * max_value({green.r, 0, green.b}));
    EXPECT_GE(min_value(green), 0);
}

TEST(Spectrum, LightsHaveLuminanceOneAndKeepTheirColour) {
    const Rgb equal = rgb_from_pairs(std::vector<SpectrumSample>{{200, 30}, {900, 30}}, SpectrumKind::illuminant);
    EXPECT_NEAR(luminance(equal), 1, 1e-4);
    EXPECT_NEAR(chromaticity(equal).x, 1.0 / 3, 0.003);
    EXPECT_NEAR(chromaticity(equal).y, 1.0 / 3, 0.003);
    EXPECT_EQ(rgb_from_pairs(std::vector<SpectrumSample>{{200, 0}, {900, 0}}, SpectrumKind::illuminant), Rgb());
}

TEST(Spectrum, MatchingFunctionsHaveTheKnownIntegral) {
    const Xyz xyz = xyz_from_spectrum([](double) { return 1.0; });
    EXPECT_NEAR(xyz.y, 106.857, 0.15);
    EXPECT_NEAR(xyz.x / xyz.y, 1, 0.01);
    EXPECT_NEAR(xyz.z / xyz.y, 1, 0.01);
}

TEST(Spectrum, MalformedSpectraAreRefused) {
    const auto reduce = [](std::vector<SpectrumSample> samples) {
        return rgb_from_pairs(samples, SpectrumKind::unbounded);
    };
    EXPECT_THROW(reduce({}), InputError);
    EXPECT_THROW(reduce({{400, 1}, {400, 1}}), InputError);
    EXPECT_THROW(reduce({{500, 1}, {400, 1}}), InputError);
    EXPECT_THROW(reduce({{400, -1}, {500, 1}}), InputError);
    EXPECT_THROW(reduce({{400, std::nanf("")}, {500, 1}}), InputError);
    EXPECT_THROW(reduce({{std::numeric_limits<float>::infinity(), 1}}), InputError);
}

TEST(Blackbody, HasTheKnownChromaticities) {
    const Chromaticity daylight = chromaticity(blackbody_rgb(6504));
    EXPECT_NEAR(daylight.x, 0.3135, 0.002);
    EXPECT_NEAR(daylight.y, 0.3237, 0.002);
    const Chromaticity bulb = chromaticity(blackbody_rgb(2856));
    EXPECT_NEAR(bulb.x, 0.4476, 0.003);
    EXPECT_NEAR(bulb.y, 0.4074, 0.003);
    EXPECT_NEAR(luminance(blackbody_rgb(4000)), 1, 1e-4);
    EXPECT_THROW(blackbody_rgb(0), InputError);
    EXPECT_THROW(blackbody_rgb(std::nan("")), InputError);
}

TEST(Blackbody, EmissionHasAPeakOfOne) {
    // At 5270 K the peak is at 550 nm, where the eye's is: the mean of the spectrum over the luminous range is just
    // below 1.
    EXPECT_NEAR(luminance(blackbody_emission(5270)), 106.9f, 3.0f);
    // A warm body's peak lies in the infrared: of it, little is seen, and less the cooler it is.
    const float warm = luminance(blackbody_emission(1500)), warmer = luminance(blackbody_emission(2000));
    EXPECT_LT(warm, 0.5f * warmer);
    EXPECT_LT(warmer, 20.0f);
    EXPECT_GT(blackbody_emission(1500).r, blackbody_emission(1500).g);
    EXPECT_EQ(blackbody_emission(0), Rgb());
    EXPECT_EQ(blackbody_emission(-5), Rgb());
    EXPECT_TRUE(is_finite(blackbody_emission(1)));
}

TEST(WhiteBalance, MakesDaylightWhite) {
    // Of the CIE's tables: chromaticities of D50, D55 and D75, whose temperatures are by the older constant.
    const struct {
        double temperature, x, y;
    } daylights[] = {{5000, 0.34567, 0.35850}, {5500, 0.33242, 0.34743}, {7500, 0.29902, 0.31485}};
    for (const auto& [temperature, x, y] : daylights) {
        const Rgb white = white_balance(temperature) * rgb_from_xyz({x / y, 1, (1 - x - y) / y});
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(white[c], 1, 3e-3f) << temperature;
        }
    }
    const Rgb white = white_balance(6504) * Rgb(1.0f);
    EXPECT_LT(max_value(white) / min_value(white), 1.003f);
}

TEST(WhiteBalance, IsThatOfABlackBodyWhereDaylightEnds) {
    const Xyz xyz = blackbody_xyz(3000);
    const Rgb white = white_balance(3000) * rgb_from_xyz({xyz.x / xyz.y, 1, xyz.z / xyz.y});
    EXPECT_LT(max_value(white) / min_value(white), 1.005f);
    EXPECT_THROW(white_balance(999), InputError);
    EXPECT_THROW(white_balance(1e9), InputError);
    EXPECT_THROW(white_balance(std::nan("")), InputError);
}

TEST(SensorBalance, IsCloseToThatOfTheObserverAndContinuous) {
    const auto ratio = [](double t) { return sensor_balance(t) * Rgb(1.0f) / (white_balance(t) * Rgb(1.0f)); };
    // Below, the white is that of a black body.
    for (double t = 4000; t < 12000; t *= 1.01) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(ratio(t)[c], 1, 0.12f) << t;
            EXPECT_NEAR(ratio(1.01 * t)[c], ratio(t)[c], 5e-3f) << t;
        }
    }
    // Of what is white in the scene.
    const Rgb white = sensor_balance(5000) * Rgb(1.0f);
    EXPECT_NEAR(white.r, 0.799f, 2e-3f);
    EXPECT_NEAR(white.g, 1.011f, 2e-3f);
    EXPECT_NEAR(white.b, 1.303f, 2e-3f);
}

TEST(ColourMatrix, TheInverseUndoesIt) {
    const ColourMatrix m = white_balance(4000);
    const Rgb there_and_back = m.inverse() * (m * Rgb(1, 2, 3));
    EXPECT_NEAR(there_and_back.r, 1, 1e-5f);
    EXPECT_NEAR(there_and_back.g, 2, 1e-5f);
    EXPECT_NEAR(there_and_back.b, 3, 1e-5f);
    EXPECT_EQ(ColourMatrix() * Rgb(0.1f, 1e30f, 3), Rgb(0.1f, 1e30f, 3));
}

TEST(NamedSpectrum, GoldLooksGold) {
    const Rgb gold = normal_reflectance(named_spectrum("metal-Au-eta"), named_spectrum("metal-Au-k"));
    expect_near(gold, Rgb(1.0f, 0.78f, 0.34f), 0.06f);
    const Rgb copper = normal_reflectance(named_spectrum("metal-Cu-eta"), named_spectrum("metal-Cu-k"));
    EXPECT_GT(copper.r, copper.g + 0.15f);
    EXPECT_GT(copper.g, copper.b);
    const Rgb silver = normal_reflectance(named_spectrum("metal-Ag-eta"), named_spectrum("metal-Ag-k"));
    EXPECT_GT(min_value(silver), 0.9f);
    const Rgb brass = normal_reflectance(named_spectrum("metal-CuZn-eta"), named_spectrum("metal-CuZn-k"));
    EXPECT_GT(brass.r, brass.g);
    EXPECT_GT(brass.g, brass.b + 0.2f);
}

TEST(NamedSpectrum, AluminiumIsCloseToOtherReductions) {
    // Those of files that give it as rgb were made without regard to white, which raises red by a fifth.
    const Rgb eta = named_spectrum("metal-Al-eta"), k = named_spectrum("metal-Al-k");
    const Rgb other_eta(1.65746f, 0.880369f, 0.521229f), other_k(9.223869f, 6.269523f, 4.837001f);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(eta[c] / other_eta[c], 1, 0.25);
        EXPECT_NEAR(k[c] / other_k[c], 1, 0.25);
    }
    expect_near(normal_reflectance(eta, k), normal_reflectance(other_eta, other_k), 0.02f);
}

TEST(NamedSpectrum, GlassesHaveTheirCatalogueIndex) {
    const std::pair<const char*, float> catalogue[] = {
        {"glass-BK7", 1.5168f}, {"glass-BAF10", 1.67003f}, {"glass-FK51A", 1.48656f}, {"glass-LASF9", 1.85025f},
        {"glass-F5", 1.67271f}, {"glass-F10", 1.72828f},   {"glass-F11", 1.78472f}};
    for (const auto& [name, index] : catalogue) {
        ASSERT_TRUE(glass_index(name)) << name;
        EXPECT_NEAR(*glass_index(name), index, 5e-5) << name;
        const Rgb rgb = named_spectrum(name);
        EXPECT_LT(rgb.r, rgb.g) << name;
        EXPECT_LT(rgb.g, rgb.b) << name;
        EXPECT_NEAR(mean(rgb), index, 0.02) << name;
    }
    EXPECT_FALSE(glass_index("metal-Au-eta"));
}

TEST(NamedSpectrum, IlluminantsAreLightsOfLuminanceOne) {
    expect_near(named_spectrum("stdillum-D65"), Rgb(1), 0.002f);
    const Rgb bulb = named_spectrum("stdillum-A");
    expect_near(bulb, blackbody_rgb(2856), 0.02f);
    for (const std::string& name : spectrum_names()) {
        if (name.find("illum") != std::string::npos) {
            EXPECT_NEAR(luminance(named_spectrum(name)), 1, 1e-3) << name;
        }
    }
}

TEST(NamedSpectrum, UnknownNamesListTheKnownOnes) {
    EXPECT_EQ(spectrum_names().size(), 37u);
    for (const std::string& name : spectrum_names()) {
        const auto rgb = find_named_spectrum(name);
        ASSERT_TRUE(rgb) << name;
        EXPECT_GE(min_value(*rgb), 0) << name;
        if (name.ends_with("-eta") || name.starts_with("glass")) {
            EXPECT_GT(min_value(*rgb), 0) << name;
        }
    }
    for (const char* name : {"", "metal-", "metal-Au", "metal-Au-", "metal-Xx-eta", "glass-XX", "stdillum-F13"}) {
        EXPECT_FALSE(find_named_spectrum(name)) << name;
    }
    try {
        named_spectrum("metal-Unobtainium-eta");
        ADD_FAILURE();
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("metal-Unobtainium-eta"), std::string::npos);
        EXPECT_NE(message.find("glass-BK7, "), std::string::npos);
    }
}

TEST(MediumPreset, HasTheMeasuredValues) {
    const auto milk = medium_preset("Wholemilk");
    ASSERT_TRUE(milk);
    EXPECT_EQ(milk->sigma_prime_s, Rgb(2.55f, 3.21f, 3.77f));
    EXPECT_EQ(milk->sigma_a, Rgb(0.0011f, 0.0024f, 0.014f));
    const auto coke = medium_preset("Coke");
    ASSERT_TRUE(coke);
    EXPECT_GT(coke->sigma_a.b, 1000 * coke->sigma_prime_s.r);
    EXPECT_FALSE(medium_preset("Unobtainium"));
    EXPECT_EQ(medium_preset_names().size(), 47u);
}

}  // namespace
}  // namespace wend
