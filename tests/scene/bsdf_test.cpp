#include <tests/sampling/verdicts.h>
#include <tests/support/chi_square_sphere.h>
#include <tests/support/measured_tables.h>
#include <wend/medium/fresnel.h>
#include <wend/medium/microfacet.h>
#include <wend/medium/phase.h>
#include <wend/scene/bsdf/bsdf.h>
#include <wend/scene/bsdf/facet_albedo.h>
#include <wend/scene/bsdf/sheen.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace wend {
namespace {

struct Model {
    std::string name;
    Bsdf bsdf;
};

CoatedBsdf coated(const CoatedBsdf::Base& base, float alpha, float thickness = 0, const Rgb& albedo = Rgb(0.0f)) {
    CoatedBsdf b;
    b.coat = {1.5f, alpha, alpha};
    b.base = base;
    b.thickness = thickness;
    b.albedo = albedo;
    b.mean_cosine = 0.3f;
    b.returned = coat_return(1.5f, thickness);
    b.max_depth = 100;
    return b;
}

PrincipledBsdf principled(float metallic, float alpha, float coat = 0) {
    static const FacetAlbedo glass(1.5f), sapphire(1.77f);
    PrincipledBsdf b;
    b.base = Rgb(0.8f, 0.5f, 0.1f);
    b.metallic = metallic;
    b.alpha = alpha;
    b.coat = coat;
    b.coat_alpha = 0.3f;
    b.coat_ior = 1.77f;
    b.below = &glass;
    b.above = &sapphire;
    return b;
}

PrincipledBsdf waxen(float share, float even) {
    PrincipledBsdf b = principled(0, 0.3f);
    b.has_inside = true;
    b.subsurface = share;
    b.entry_alpha = 0.3f;
    b.entry_even = even;
    return b;
}

MeasuredBsdf measured(bool is_isotropic) {
    static const MeasuredTables isotropic(test::uneven_reflectance(true)), anisotropic(test::uneven_reflectance(false));
    return {is_isotropic ? &isotropic : &anisotropic};
}

/// With all that artists add to it.
PrincipledBsdf tinted(float metallic) {
    PrincipledBsdf b = principled(metallic, 0.4f, 0.8f);
    b.aspect = 0.6f;
    b.specular_tint = Rgb(0.9f, 0.5f, 0.2f);
    b.coat_tint = Rgb(0.5f, 0.7f, 0.9f);
    b.diffuse_roughness = 0.8f;
    return b;
}

/// Below fibres.
PrincipledBsdf fuzzy(float roughness, float coat = 0) {
    PrincipledBsdf b = principled(0, 0.3f, coat);
    b.sheen = 0.8f;
    b.sheen_tint = Rgb(1.0f, 0.6f, 0.3f);
    b.sheen_roughness = roughness;
    return b;
}

DisneySheetBsdf sheet(float spec_trans) {
    DisneySheetBsdf b;
    b.base = Rgb(0.5f, 0.4f, 0.2f);
    b.spec_trans = spec_trans;
    b.diff_trans = 0.4f;
    b.alpha_x = 0.5f;
    b.alpha_y = 0.3f;
    b.passing_alpha_x = 0.3f;
    b.passing_alpha_y = 0.2f;
    b.sheen = 0.2f;
    b.sheen_tint = 0.5f;
    b.flatness = 0.3f;
    b.spec_tint = 0.5f;
    return b;
}

DisneyBsdf disney(float metallic, float spec_trans) {
    DisneyBsdf b;
    b.base = Rgb(0.5f, 0.4f, 0.2f);
    b.metallic = metallic;
    b.spec_trans = spec_trans;
    b.alpha_x = 0.5f;
    b.alpha_y = 0.3f;
    b.coat = 0.7f;
    b.sheen = 0.2f;
    b.flatness = 0.3f;
    b.spec_tint = 0.5f;
    return b;
}

DielectricBsdf coloured_glass(float alpha) {
    DielectricBsdf b{1.5f, alpha, alpha};
    b.reflectance = Rgb(0.9f, 0.5f, 0.1f);
    b.transmittance = Rgb(0.2f, 0.4f, 0.8f);
    return b;
}

DielectricBsdf antireflective(float ior, float alpha) {
    DielectricBsdf b{ior, alpha, alpha};
    b.is_antireflective = true;
    return b;
}

/// Reflects all of red light but for the tint.
ConductorBsdf tinted_metal(float alpha, const Rgb& tint = Rgb(0.9f, 0.6f, 0.3f)) {
    return {Rgb(0.0f, 0.9f, 1.5f), Rgb(1, 2.4f, 1.9f), alpha, alpha, FacetSlopes::ggx, tint};
}

const std::vector<Model>& models() {
    static const std::vector<Model> all = {
        {"lambert", LambertBsdf{Rgb(0.8f, 0.5f, 0.2f)}},
        {"conductor", ConductorBsdf{Rgb(0.2f, 0.9f, 1.5f), Rgb(3.9f, 2.4f, 1.9f), 0.3f, 0.3f}},
        {"conductor_brushed", ConductorBsdf{Rgb(0.2f), Rgb(3.9f), 0.6f, 0.2f}},
        {"conductor_mirror", ConductorBsdf{Rgb(0.2f), Rgb(3.9f), 0, 0}},
        {"dielectric", DielectricBsdf{1.5f, 0.4f, 0.4f}},
        {"dielectric_brushed", DielectricBsdf{1.33f, 0.5f, 0.25f}},
        {"dielectric_bubble", DielectricBsdf{1 / 1.5f, 0.4f, 0.4f}},
        {"dielectric_smooth", DielectricBsdf{1.5f, 0, 0}},
        {"dielectric_odds", DielectricBsdf{1.5f, 0.4f, 0.4f, 6}},
        {"dielectric_smooth_odds", DielectricBsdf{1.5f, 0, 0, 0.1f}},
        {"transmission", DiffuseTransmissionBsdf{Rgb(0.1f, 0.3f, 0.5f), Rgb(0.6f, 0.4f, 0.5f)}},
        {"thin", ThinDielectricBsdf{1.5f}},
        {"coated", coated(LambertBsdf{Rgb(0.7f, 0.4f, 0.1f)}, 0.3f)},
        {"coated_smooth", coated(LambertBsdf{Rgb(0.7f, 0.4f, 0.1f)}, 0)},
        {"coated_milky", coated(LambertBsdf{Rgb(0.7f, 0.4f, 0.1f)}, 0, 0.5f, Rgb(0.9f))},
        {"coated_black_milky", coated(LambertBsdf{Rgb(0.0f)}, 0.2f, 0.5f, Rgb(0.9f))},
        {"coated_metal", coated(ConductorBsdf{Rgb(0.2f, 0.9f, 1.5f), Rgb(3.9f, 2.4f, 1.9f), 0.3f, 0.3f}, 0.2f, 0.1f)},
        {"coated_metal_smooth", coated(ConductorBsdf{Rgb(0.2f), Rgb(3.9f), 0.4f, 0.2f}, 0)},
        {"coated_mirror", coated(ConductorBsdf{Rgb(0.2f), Rgb(3.9f), 0, 0}, 0, 0.1f)},
        {"coated_mirror_milky", coated(ConductorBsdf{Rgb(0.2f), Rgb(3.9f), 0, 0}, 0, 0.3f, Rgb(0.8f))},
        {"principled", principled(0, 0.3f)},
        {"principled_half_metal", principled(0.5f, 0.5f)},
        {"principled_metal", principled(1, 0.4f)},
        {"principled_coated", principled(0.3f, 0.6f, 0.8f)},
        {"hair", HairBsdf(0.4f, 1.55f, Rgb(0.1f, 0.3f, 1), 0.3f, 0.4f, 0.035f)},
        {"hair_sharp", HairBsdf(-0.7f, 1.55f, Rgb(0.5f), 0.25f, 0.3f, 0.1f)},
        {"conductor_beckmann",
         ConductorBsdf{Rgb(0.2f, 0.9f, 1.5f), Rgb(3.9f, 2.4f, 1.9f), 0.5f, 0.25f, FacetSlopes::beckmann}},
        {"dielectric_beckmann", DielectricBsdf{1.5f, 0.4f, 0.3f, 1, 0.25f, FacetSlopes::beckmann}},
        {"dielectric_beckmann_bubble", DielectricBsdf{1 / 1.5f, 0.4f, 0.3f, 1, 0.25f, FacetSlopes::beckmann}},
        {"dielectric_coloured", coloured_glass(0.4f)},
        {"dielectric_smooth_coloured", coloured_glass(0)},
        {"thin_coloured", ThinDielectricBsdf{1.5f, Rgb(0.9f, 0.5f, 0.1f), Rgb(0.2f, 0.4f, 0.8f)}},
        {"principled_waxen", waxen(0.6f, 0)},
        {"principled_skin", waxen(1, 0.5f)},
        {"measured", measured(true)},
        {"measured_anisotropic", measured(false)},
        {"principled_tinted", tinted(0.2f)},
        {"principled_brushed", tinted(1)},
        {"disney", disney(0.2f, 0)},
        {"disney_half_glass", disney(0.1f, 0.6f)},
        {"disney_glass", disney(0, 1)},
        {"principled_fuzzy", fuzzy(0.5f)},
        {"principled_smooth_fuzz", fuzzy(0)},
        {"principled_rough_fuzz", fuzzy(1, 0.8f)},
        {"sheet", sheet(0)},
        {"sheet_half_glass", sheet(0.6f)},
        {"sheet_glass", sheet(1)},
        // At a grazing angle a rougher one is cut off where light enters no facet, which integrals of cells are too
        // coarse for.
        {"dielectric_antireflective", antireflective(1.5f, 0.08f)},
        {"dielectric_antireflective_bubble", antireflective(1 / 1.5f, 0.4f)},
        {"dielectric_antireflective_smooth", antireflective(1.5f, 0)},
        {"conductor_tinted", tinted_metal(0.4f)}};
    return all;
}

/// Steep, oblique and grazing, from both sides.
const std::vector<Vec3>& incidences() {
    static const std::vector<Vec3> all = {normalize(Vec3(0.1f, 0.05f, 1)), normalize(Vec3(-0.8f, 0.3f, 0.7f)),
                                          normalize(Vec3(0.3f, -1, 0.25f)), normalize(Vec3(0.4f, 0.2f, -1)),
                                          normalize(Vec3(-0.9f, 0.5f, -0.4f))};
    return all;
}

Rgb evaluate(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi) {
    return std::visit([&](const auto& b) { return b.evaluate(wo, wi); }, bsdf);
}
float density(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi) {
    return std::visit([&](const auto& b) { return b.density(wo, wi); }, bsdf);
}
std::optional<BsdfSample> sample(const Bsdf& bsdf, const Vec3& wo, Pcg32& random) {
    const float u = random.uniform();
    const Vec2 u2 = random.uniform2();
    return std::visit([&](const auto& b) { return b.sample(wo, u, u2); }, bsdf);
}
bool is_specular(const Bsdf& bsdf) {
    return std::visit([](const auto& b) { return b.is_specular(); }, bsdf);
}

/// Samples against the density; specular ones count as "no sample", whose share is what the density lacks to 1.
test::SphereTest sphere_test(const Bsdf& drawn, const Bsdf& claimed, const Vec3& wo, std::uint64_t seed = 1) {
    test::SphereTestOptions options;
    options.seed = seed;
    options.cosine_cells = 16;
    options.azimuth_cells = 24;
    return test::chi_square_sphere(
        [&](Pcg32& random) -> std::optional<Vec3> {
            const auto s = sample(drawn, wo, random);
            return s && !s->specular ? std::optional(s->direction) : std::nullopt;
        },
        [&](const Vec3& wi) { return density(claimed, wo, wi); }, options);
}

/// What densities do not depend on, left out.
Bsdf without_walks(Bsdf bsdf) {
    if (auto* coated = std::get_if<CoatedBsdf>(&bsdf)) {
        coated->max_depth = 1;
    }
    return bsdf;
}

TEST(SlowBsdf, SamplesFollowTheDensity) {
    std::uint64_t seed = 0;
    for (const Model& model : models()) {
        if (is_specular(model.bsdf)) {
            continue;
        }
        const Bsdf bsdf = without_walks(model.bsdf);
        for (const Vec3& wo : incidences()) {
            const auto result = sphere_test(bsdf, bsdf, wo, ++seed);
            EXPECT_TRUE(test::follows_density(result, model.name, 40)) << model.name << ' ' << wo;
            const double integral =
                std::accumulate(result.expected.begin(), result.expected.end() - 1, 0.0) / result.options.samples;
            EXPECT_LT(integral, 1.001) << model.name << ' ' << wo;
        }
    }
}

TEST(Bsdf, AnotherRoughnessIsRejected) {
    const Vec3 wo = incidences()[1];
    EXPECT_LT(
        sphere_test(ConductorBsdf{Rgb(0.2f), Rgb(3), 0.3f, 0.3f}, ConductorBsdf{Rgb(0.2f), Rgb(3), 0.31f, 0.3f}, wo)
            .result.p_value,
        test::failing);
    EXPECT_LT(sphere_test(DielectricBsdf{1.5f, 0.4f, 0.4f}, DielectricBsdf{1.55f, 0.4f, 0.4f}, wo).result.p_value,
              test::failing);
}

TEST(Bsdf, SampleReportsValueAndDensityOfItsDirection) {
    Pcg32 random(1);
    for (const Model& model : models()) {
        for (const Vec3& wo : incidences()) {
            for (int i = 0; i < 500; ++i) {
                const auto s = sample(model.bsdf, wo, random);
                if (!s) {
                    continue;
                }
                EXPECT_NEAR(length(s->direction), 1, 1e-4f);
                EXPECT_GT(s->density, 0);
                EXPECT_TRUE(is_finite(s->value));
                EXPECT_GE(min_value(s->value), 0);
                if (!s->specular) {
                    EXPECT_FLOAT_EQ(s->density, density(model.bsdf, wo, s->direction));
                    EXPECT_FLOAT_EQ(s->value.g, evaluate(model.bsdf, wo, s->direction).g);
                }
            }
        }
    }
}

/// Means over samples of the share of energy that goes on: radiance in a medium of index n is scaled by n².
void add_energy(const Bsdf& bsdf, const Vec3& wo, int samples, Pcg32& random, std::vector<Moments>& moments) {
    for (int i = 0; i < samples; ++i) {
        const auto s = sample(bsdf, wo, random);
        const float scale = s ? sqr(index_ratio(bsdf, wo, s->direction)) / s->density : 0;
        for (std::size_t c = 0; c < 3; ++c) {
            moments[c].add(s ? s->value[static_cast<int>(c)] * scale : 0);
        }
    }
}

std::vector<Moments> energy(const Bsdf& bsdf, const Vec3& wo, int samples) {
    std::vector<Moments> moments(3);
    Pcg32 random(2);
    add_energy(bsdf, wo, samples, random, moments);
    return moments;
}

TEST(Bsdf, NoneGainsEnergy) {
    for (const Model& model : models()) {
        for (const Vec3& wo : incidences()) {
            for (const Moments& share : energy(model.bsdf, wo, 20000)) {
                EXPECT_LE(share.mean(), 1 + 4 * share.standard_error() + 1e-5) << model.name << ' ' << wo;
                EXPECT_GT(share.mean(), 0.05) << model.name << ' ' << wo;
            }
        }
    }
}

TEST(Lambert, AlbedoIsTheReflectance) {
    for (const Vec3& wo : incidences()) {
        const auto shares = energy(LambertBsdf{Rgb(0.8f, 0.5f, 0.2f)}, wo, 1000);
        EXPECT_TRUE(test::is_within_one_percent(shares[0], 0.8));
        EXPECT_TRUE(test::is_within_one_percent(shares[2], 0.2));
    }
}

TEST(Conductor, TheTintIsAFactorOfWhatIsReflected) {
    Pcg32 random(1);
    const Rgb tint(0.9f, 0.6f, 0.3f);
    for (const float alpha : {0.0f, 0.4f}) {
        const ConductorBsdf clear = tinted_metal(alpha, Rgb(1.0f)), tinted = tinted_metal(alpha, tint);
        for (const Vec3& wo : incidences()) {
            const float u = random.uniform();
            const Vec2 u2 = random.uniform2();
            const auto plain = clear.sample(wo, u, u2), coloured = tinted.sample(wo, u, u2);
            ASSERT_EQ(plain.has_value(), coloured.has_value());
            if (!plain) {
                continue;
            }
            EXPECT_EQ(coloured->direction, plain->direction);
            EXPECT_EQ(coloured->density, plain->density);
            for (int c = 0; c < 3; ++c) {
                EXPECT_FLOAT_EQ(coloured->value[c], tint[c] * plain->value[c]);
                EXPECT_FLOAT_EQ(directional_albedo(tinted, wo)[c], tint[c] * directional_albedo(clear, wo)[c]);
            }
        }
    }
}

TEST(Conductor, OfNoIndexReflectsAllFromEverywhere) {
    for (const Vec3& wo : incidences()) {
        EXPECT_NEAR(tinted_metal(0, Rgb(1.0f)).sample(wo, 0.5f, {0.5f, 0.5f})->value.r, 1, 1e-5) << wo;
    }
}

TEST(Dielectric, SmoothLosesNothingOnAnyPath) {
    const DielectricBsdf bsdf{1.5f, 0, 0};
    for (const Vec3& wo : incidences()) {
        const Moments share = energy(bsdf, wo, 2000)[0];
        EXPECT_NEAR(share.mean(), 1, 1e-5);
        EXPECT_LT(share.standard_error(), 1e-6);
    }
}

TEST(Dielectric, ColoursAreFactorsOfWhatIsReflectedAndOfWhatPasses) {
    Pcg32 random(1);
    for (const float alpha : {0.0f, 0.4f}) {
        const DielectricBsdf clear{1.5f, alpha, alpha}, coloured = coloured_glass(alpha);
        for (const Vec3& wo : incidences()) {
            for (int i = 0; i < 200; ++i) {
                const float u = random.uniform();
                const Vec2 u2 = random.uniform2();
                const auto a = clear.sample(wo, u, u2), b = coloured.sample(wo, u, u2);
                ASSERT_EQ(a.has_value(), b.has_value());
                if (a) {
                    const bool reflects = a->direction.z * wo.z > 0;
                    EXPECT_EQ(a->direction, b->direction);
                    EXPECT_EQ(a->density, b->density);
                    EXPECT_EQ(b->value, (reflects ? coloured.reflectance : coloured.transmittance) * a->value.r);
                }
            }
        }
    }
}

TEST(Dielectric, WithoutReflectionsAllPassesThatCan) {
    DielectricBsdf bsdf = antireflective(1.5f, 0);
    bsdf.reflectance = Rgb(0.0f);
    Pcg32 random(1);
    for (const Vec3& wo : incidences()) {
        const auto s = sample(bsdf, wo, random);
        ASSERT_TRUE(s);
        if (refract(wo, Vec3(0, 0, 1), bsdf.ior)) {
            EXPECT_LT(s->direction.z * wo.z, 0);
            EXPECT_FLOAT_EQ(s->value.r * sqr(index_ratio(bsdf, wo, s->direction)) / s->density, 1);
            EXPECT_EQ(directional_albedo(bsdf, wo), Rgb(1));
        } else {
            EXPECT_GT(s->direction.z * wo.z, 0);
            EXPECT_TRUE(is_black(s->value));
            EXPECT_TRUE(is_black(directional_albedo(bsdf, wo)));
        }
    }
    // Rough glass whose reflections are absorbed has lost what this one lets through.
    DielectricBsdf absorbing{1.5f, 0.2f, 0.2f};
    absorbing.reflectance = Rgb(0.0f);
    const Vec3 wo = incidences()[2];
    const Moments lost = energy(absorbing, wo, 20000)[0], kept = energy(antireflective(1.5f, 0.2f), wo, 20000)[0];
    EXPECT_GT(kept.mean(), lost.mean() + 0.05);
    EXPECT_LE(kept.mean(), 1 + 4 * kept.standard_error());
}

TEST(Dielectric, OddsChangeHowOftenLightIsReflectedAndNothingElse) {
    for (const float alpha : {0.0f, 0.3f}) {
        for (const auto& [odds, share] :
             {std::pair(1.0f / 8, 0.25f), std::pair(8.0f, 0.25f), std::pair(1.0f / 8, 0.7f)}) {
            const DielectricBsdf plain{1.4f, alpha, alpha}, bsdf{1.4f, alpha, alpha, odds, share};
            for (const Vec3& wo : incidences()) {
                SCOPED_TRACE(testing::Message()
                             << "alpha " << alpha << ", odds " << odds << ", share " << share << ", from " << wo);
                Moments reflected, plainly, weight, plain_weight, kept, plainly_kept;
                Pcg32 random(5);
                for (int i = 0; i < 100000; ++i) {
                    const auto s = sample(bsdf, wo, random), t = sample(plain, wo, random);
                    const bool reflects = s && s->direction.z * wo.z > 0, plain_one = t && t->direction.z * wo.z > 0;
                    reflected.add(reflects ? 1 : 0);
                    plainly.add(plain_one ? 1 : 0);
                    weight.add(reflects ? s->value.r / s->density : 0);
                    plain_weight.add(plain_one ? t->value.r / t->density : 0);
                    kept.add(s ? 1 / static_cast<double>(s->density_ratio) : 0);
                    plainly_kept.add(t ? 1 : 0);
                    if (s && !s->specular && i % 100 == 0) {
                        EXPECT_NEAR(s->density, s->density_ratio * plain.density(wo, s->direction), 1e-4f * s->density);
                        EXPECT_EQ(s->value, plain.evaluate(wo, s->direction));
                    }
                }
                const auto error = [](const Moments& a, const Moments& b) {
                    return 1e-5 + 4.5 * std::hypot(a.standard_error(), b.standard_error());
                };
                EXPECT_NEAR(weight.mean(), plain_weight.mean(), error(weight, plain_weight));
                EXPECT_NEAR(kept.mean(), plainly_kept.mean(), error(kept, plainly_kept));
                if (plainly.mean() < 0.9) {
                    EXPECT_GT((reflected.mean() - plainly.mean()) * (odds - 1), 0);
                }
                // A part stays as it was.
                EXPECT_GE(reflected.mean(), (share - 0.01) * plainly.mean());
                EXPECT_GE(1 - reflected.mean(), (share - 0.01) * (1 - plainly.mean()));
            }
        }
    }
}

TEST(Dielectric, RoughReflectanceTendsToFresnels) {
    const DielectricBsdf bsdf{1.5f, 0.02f, 0.02f};
    for (const Vec3& wo : {incidences()[0], incidences()[1], incidences()[3]}) {
        Moments reflected, transmitted;
        Pcg32 random(3);
        for (int i = 0; i < 400000; ++i) {
            const auto s = sample(bsdf, wo, random);
            const bool passes = s && s->direction.z * wo.z < 0;
            reflected.add(s && !passes ? s->value.r / s->density : 0);
            transmitted.add(passes ? s->value.r / s->density * sqr(index_ratio(bsdf, wo, s->direction)) : 0);
        }
        const double expected = fresnel_dielectric(wo.z, 1.5f);
        EXPECT_NEAR(reflected.mean(), expected, 0.02 * expected + 4 * reflected.standard_error());
        EXPECT_NEAR(transmitted.mean(), 1 - expected, 0.02 + 4 * transmitted.standard_error());
    }
}

TEST(SlowPrincipled, AWhiteSurfaceLosesNothing) {
    for (const float metallic : {0.0f, 0.4f, 1.0f}) {
        for (const float alpha : {PrincipledBsdf::least_alpha, 0.05f, 0.3f, 0.6f}) {
            PrincipledBsdf white = principled(metallic, alpha);
            white.base = Rgb(1.0f);
            for (const Vec3& wo : incidences()) {
                EXPECT_TRUE(test::is_within_one_percent(energy(white, wo, 400000)[0], 1, 2e-3))
                    << metallic << ' ' << alpha << ' ' << wo;
            }
        }
    }
    for (const float roughness : {0.2f, 0.6f, 1.0f}) {
        PrincipledBsdf velvet = fuzzy(roughness, 0.7f);
        velvet.base = velvet.sheen_tint = Rgb(1.0f);
        for (const Vec3& wo : incidences()) {
            EXPECT_TRUE(test::is_within_one_percent(energy(velvet, wo, 400000)[0], 1, 2e-3)) << roughness << ' ' << wo;
        }
    }
    for (const float roughness : {0.5f, 1.0f}) {
        PrincipledBsdf chalk = principled(0, 0.3f);
        chalk.base = Rgb(1.0f);
        chalk.diffuse_roughness = roughness;
        for (const Vec3& wo : incidences()) {
            EXPECT_TRUE(test::is_within_one_percent(energy(chalk, wo, 400000)[0], 1, 2e-3)) << roughness << ' ' << wo;
        }
    }
    // Facets in single reflection alone lose a quarter and more.
    const Moments lost = energy(ConductorBsdf{Rgb(1.0f), Rgb(300), 1, 1}, incidences()[1], 20000)[0];
    EXPECT_LT(lost.mean(), 0.75);
}

TEST(SlowPrincipled, ReflectsItsAlbedo) {
    for (const float metallic : {0.0f, 0.5f, 1.0f}) {
        for (const float coat : {0.0f, 0.7f}) {
            PrincipledBsdf b = principled(metallic, 0.4f, coat);
            b.coat_tint = Rgb(0.5f, 0.7f, 0.9f);
            b.diffuse_roughness = coat;
            b.sheen = coat;
            b.sheen_tint = Rgb(0.9f, 0.4f, 0.7f);
            b.specular_tint = metallic > 0 ? Rgb(1.0f) : Rgb(0.9f, 0.5f, 0.2f);
            for (const Vec3& wo : incidences()) {
                const auto shares = energy(b, wo, 400000);
                for (std::size_t c = 0; c < 3; ++c) {
                    EXPECT_TRUE(test::is_within_one_percent(
                        shares[c], static_cast<double>(b.albedo(wo)[static_cast<int>(c)]), 2e-3))
                        << metallic << ' ' << coat << ' ' << wo << ' ' << shares[c].mean();
                }
            }
        }
    }
}

TEST(SlowPrincipled, WhatIsNotReflectedGoesInsideAndComesOut) {
    for (const float even : {0.0f, 0.5f, 1.0f}) {
        for (const float share : {0.5f, 1.0f}) {
            PrincipledBsdf white = waxen(share, even);
            white.base = Rgb(1.0f);
            for (const Vec3& wo : incidences()) {
                EXPECT_TRUE(test::is_within_one_percent(energy(white, wo, 400000)[0], 1, 2e-3))
                    << even << ' ' << share << ' ' << wo;
            }
        }
    }
}

// What Cycles 5.0 reflects of a white sky by its node of fibres alone.
TEST(Sheen, AlbedoIsThatOfCycles) {
    struct Seen {
        float cosine, roughness, albedo;
    };
    for (const Seen& seen :
         {Seen{1, 1, 0.342f}, Seen{0.643f, 1, 0.443f}, Seen{0.2f, 1, 0.646f}, Seen{1, 0.7f, 0.104f},
          Seen{0.454f, 0.7f, 0.340f}, Seen{0.2f, 0.7f, 0.532f}, Seen{1, 0.5f, 0.0187f}, Seen{0.643f, 0.5f, 0.0878f},
          Seen{0.2f, 0.5f, 0.426f}, Seen{0.454f, 0.3f, 0.032f}, Seen{0.302f, 0.3f, 0.115f}}) {
        const Sheen fibres(direction_from_cosine(seen.cosine, 0.3f), seen.roughness);
        EXPECT_NEAR(fibres.albedo(), seen.albedo, 4e-3f) << seen.cosine << ' ' << seen.roughness;
    }
}

TEST(Sheen, IsTheSameFromBehind) {
    const Vec3 wo = normalize(Vec3(0.3f, -0.5f, 0.4f)), wi = normalize(Vec3(-0.6f, 0.1f, 0.5f));
    const auto behind = [](const Vec3& w) { return Vec3(w.x, w.y, -w.z); };
    const Sheen front(wo, 0.6f), back(behind(wo), 0.6f);
    EXPECT_EQ(front.albedo(), back.albedo());
    EXPECT_EQ(front.density(wi), back.density(behind(wi)));
    EXPECT_EQ(front.density(behind(wi)), 0);
    EXPECT_EQ(front.sample({0.3f, 0.7f}), behind(back.sample({0.3f, 0.7f})));
}

TEST(Principled, FacetsAreThoseOfFresnelWhereTheyAreSmooth) {
    const FacetAlbedo glass(1.5f);
    for (const float cosine : {1.0f, 0.7f, 0.2f}) {
        EXPECT_NEAR(glass.dielectric(cosine, 0), fresnel_dielectric(cosine, 1.5f), 0.004f) << cosine;
        EXPECT_NEAR(glass.white(cosine, 0), 1, 1e-3f);
    }
    EXPECT_NEAR(glass.mean_fresnel(), fresnel_diffuse_reflectance(1.5f), 1e-3f);
}

TEST(Coated, AWhiteSmoothCoatLosesNothing) {
    const auto white = coated(LambertBsdf{Rgb(1)}, 0);
    for (const Vec3& wo : incidences()) {
        EXPECT_TRUE(test::is_within_one_percent(energy(white, wo, 100000)[0], 1, 1e-3)) << wo;
    }
    // Without reflections between base and coat a good part is lost.
    auto wrong = white;
    wrong.returned = 0;
    EXPECT_FALSE(agrees(energy(wrong, incidences()[0], 100000)[0], 1, 4, 1e-3));
}

TEST(Coated, ABlackBaseReflectsFresnelsShareAlone) {
    const Vec3 wo = incidences()[1];
    Pcg32 random(4);
    const auto s = sample(coated(LambertBsdf{Rgb(0)}, 0), wo, random);
    ASSERT_TRUE(s && s->specular);
    EXPECT_NEAR(s->value.r / s->density, fresnel_dielectric(wo.z, 1.5f), 1e-6f);
}

/// Mean of the outcomes of walks, over their seeds.
Moments walked(CoatedBsdf b, const Vec3& wo, const Vec3& wi, int seeds = 400000) {
    b.returned = -1;
    Moments moments;
    for (b.seed = 0; b.seed < static_cast<std::uint64_t>(seeds); ++b.seed) {
        moments.add(b.evaluate(wo, wi).r);
    }
    return moments;
}

TEST(Coated, WalksAgreeWithTheClosedForm) {
    const Vec3 wi = normalize(Vec3(-0.3f, 0.6f, 0.5f));
    for (const float thickness : {0.01f, 0.5f}) {
        for (const int depth : {2, 5, 100}) {
            CoatedBsdf b = coated(LambertBsdf{Rgb(0.8f)}, 0, thickness);
            b.max_depth = depth;
            for (const Vec3& wo : {incidences()[0], incidences()[2]}) {
                const double exact = static_cast<double>(b.evaluate(wo, wi).r);
                const Moments walks = walked(b, wo, wi);
                EXPECT_TRUE(agrees(walks, exact, 4, 2e-4))
                    << thickness << ' ' << depth << ' ' << walks.mean() << ' ' << exact;
                EXPECT_FALSE(agrees(walks, 1.01 * exact, 4, 2e-4)) << walks.standard_error() / exact;
            }
        }
    }
}

TEST(Coated, ARoughCoatBecomesASmoothOne) {
    // Both ways to leave the coat, weighed against each other, against the one that is left without facets.
    const Vec3 wo = incidences()[1], wi = normalize(Vec3(-0.3f, 0.6f, 0.8f));
    const CoatedBsdf smooth = coated(LambertBsdf{Rgb(0.8f)}, 0, 0.2f);
    const Moments walks = walked(coated(LambertBsdf{Rgb(0.8f)}, 0.02f, 0.2f), wo, wi);
    EXPECT_NEAR(walks.mean(), smooth.evaluate(wo, wi).r, 0.01 * smooth.evaluate(wo, wi).r);
    EXPECT_LT(walks.standard_error(), 0.003 * walks.mean());
}

TEST(Coated, WhatDoesNotAbsorbGivesAllBack) {
    for (const float thickness : {0.1f, 2.0f}) {
        CoatedBsdf milk = coated(LambertBsdf{Rgb(1)}, 0, thickness, Rgb(1));
        milk.max_depth = 1000;
        EXPECT_TRUE(test::is_within_one_percent(energy(milk, incidences()[0], 400000)[0], 1, 2e-3)) << thickness;
    }
}

/// What comes back of light from wo, followed through coat, medium and base as each of them scatters it, without a
/// connection: independent of CoatedBsdf.
void add_followed(const CoatedBsdf& b, const Vec3& wo, int walks, Pcg32& random, Moments& moments) {
    const auto draw = [&random](const auto& bsdf, const Vec3& w) {
        const float u = random.uniform();
        const Vec2 u2 = random.uniform2();
        return bsdf.sample(w, u, u2);
    };
    for (int walk = 0; walk < walks; ++walk) {
        Vec3 w = -wo;  // the way that light is followed
        double weight = 1, height = static_cast<double>(b.thickness);
        bool is_outside = true;
        for (int depth = 0; depth < 10000 && weight > 0; ++depth) {
            if (is_outside || (w.z > 0 && height >= static_cast<double>(b.thickness))) {
                const auto s = draw(b.coat, -w);
                weight *= s ? static_cast<double>(s->value.r / s->density) : 0.0;
                w = s ? s->direction : w;
                if (w.z > 0) {
                    break;  // out, or reflected from outside
                }
                is_outside = false;
                height = static_cast<double>(b.thickness);
            } else if (w.z < 0 && height <= 0) {
                const auto s = std::visit([&](const auto& base) { return draw(base, -w); }, b.base);
                weight *= s ? static_cast<double>(s->value.r / s->density) : 0.0;
                w = s ? s->direction : w;
            }
            const double free = -std::log1p(-random.uniform_double()) * static_cast<double>(std::abs(w.z));
            const double ahead = w.z > 0 ? static_cast<double>(b.thickness) - height : height;
            if (free < ahead) {
                height += w.z > 0 ? free : -free;
                weight *= static_cast<double>(b.albedo.r);
                const PhaseFunction phase(HenyeyGreenstein{b.mean_cosine});
                w = phase.sample(w, random.uniform2());
            } else {
                height = w.z > 0 ? static_cast<double>(b.thickness) : 0;
            }
        }
        moments.add(weight);
    }
}

TEST(SlowCoated, ValuesAddUpToWhatIsFollowed) {
    // Both ways out of a rough coat are weighed against each other in values, and not here. As many walks as 1 % needs
    // to be seen at four standard errors: 100,000 to 3,200,000, in steps.
    constexpr int step = 100000;
    const LambertBsdf base{Rgb(0.8f)};
    const ConductorBsdf metal{Rgb(0.2f), Rgb(3.9f), 0.3f, 0.3f};
    const std::vector<Model> coats = {{"rough", coated(base, 0.3f)},
                                      {"rough_thick", coated(base, 0.5f, 0.4f)},
                                      {"rough_milk", coated(base, 0.3f, 0.5f, Rgb(0.9f))},
                                      {"metal", coated(metal, 0)},
                                      {"rough_metal", coated(metal, 0.2f, 0.1f)},
                                      {"metal_milk", coated(metal, 0, 0.5f, Rgb(0.7f))},
                                      {"rough_mirror", coated(ConductorBsdf{Rgb(0.2f), Rgb(3.9f), 0, 0}, 0.3f, 0.1f)}};
    for (const Model& model : coats) {
        for (const Vec3& wo : {incidences()[1]}) {
            const auto& b = std::get<CoatedBsdf>(model.bsdf);
            Moments expected;
            std::vector<Moments> found(3);
            Pcg32 following(8), sampling(2);
            double error = 0;
            for (int walks = 0; walks < 3200000; walks += step) {
                add_followed(b, wo, step, following, expected);
                add_energy(b, wo, step, sampling, found);
                error = std::hypot(expected.standard_error(), found[0].standard_error());
                if (error < 0.0021 * expected.mean()) {
                    break;
                }
            }
            EXPECT_NEAR(found[0].mean(), expected.mean(), 4 * error) << model.name << ' ' << wo;
            EXPECT_LT(error, 0.0025 * expected.mean()) << model.name << ' ' << wo;
        }
    }
}

TEST(Coated, AMirrorBelowACoatIsASumOfReflections) {
    const CoatedBsdf b = coated(ConductorBsdf{Rgb(0.2f), Rgb(3.9f), 0, 0}, 0, 0.1f);
    EXPECT_TRUE(b.is_specular());
    const Vec3 wo = incidences()[1];
    const auto s = b.sample(wo, 0.5f, {0.5f, 0.5f});
    ASSERT_TRUE(s && s->specular);
    const float cosine = std::sqrt(1 - (1 - sqr(wo.z)) / sqr(1.5f));
    const float f = fresnel_dielectric(wo.z, 1.5f), metal = fresnel_conductor(cosine, 0.2f, 3.9f);
    const float passed = metal * std::exp(-0.2f / cosine);
    EXPECT_NEAR(s->value.r / s->density, f + sqr(1 - f) * passed / (1 - f * passed), 1e-5f);
}

TEST(DiffuseTransmission, SharesAreItsColours) {
    const DiffuseTransmissionBsdf b{Rgb(0.1f, 0.3f, 0.5f), Rgb(0.6f, 0.4f, 0.2f)};
    Pcg32 random(6);
    Moments reflected, passed;
    const Vec3 wo = incidences()[3];
    for (int i = 0; i < 20000; ++i) {
        const auto s = sample(b, wo, random);
        ASSERT_TRUE(s);
        const bool is_reflected = s->direction.z * wo.z > 0;
        reflected.add(is_reflected ? s->value.g / s->density : 0);
        passed.add(is_reflected ? 0 : s->value.g / s->density);
    }
    EXPECT_TRUE(agrees(reflected, 0.3, 4, 1e-4));
    EXPECT_TRUE(agrees(passed, 0.4, 4, 1e-4));
}

TEST(ThinDielectric, LightGoesOnOrIsReflected) {
    const ThinDielectricBsdf glass{1.5f};
    const Vec3 wo = incidences()[0];
    const float share = glass.reflected_share(wo);
    EXPECT_NEAR(share, 2 * 0.04f / 1.04f, 2e-3f);
    const auto reflected = glass.sample(wo, share - 1e-4f, {0, 0}), passed = glass.sample(wo, share + 1e-4f, {0, 0});
    ASSERT_TRUE(reflected && passed);
    EXPECT_EQ(passed->direction, -wo);
    EXPECT_EQ(reflected->direction, Vec3(-wo.x, -wo.y, wo.z));
    EXPECT_FLOAT_EQ(reflected->density + passed->density, 1);
}

TEST(Hair, WhatDoesNotAbsorbGivesAllBack) {
    // The published white furnace (chiang2016): over all offsets and directions.
    Pcg32 random(7);
    for (const float roughness : {0.1f, 0.5f, 0.9f}) {
        Moments share;
        for (int i = 0; i < 100000; ++i) {
            const HairBsdf hair(2 * random.uniform() - 1, 1.55f, Rgb(0.0f), roughness, roughness, 0);
            const auto s = sample(hair, to_sphere(random.uniform2()), random);
            share.add(s ? s->value.r / s->density : 0);
        }
        // It is normalized to within its approximations.
        EXPECT_NEAR(share.mean(), 1, 0.02) << roughness;
    }
}

TEST(Bsdf, IsReciprocal) {
    // f(o, i) = f(i, o), with the squared ratio of indices where radiance is refracted.
    Pcg32 random(5);
    for (const Model& model : models()) {
        // The outcomes of walks are reciprocal on average alone. Fibres with tilted scales are not (chiang2016), nor
        // are layers that are weighed by albedo, and numbers that were made up.
        if (model.name.starts_with("coated_m") || model.name.starts_with("coated_black") || model.name == "coated" ||
            model.name.starts_with("hair") || model.name.starts_with("principled") ||
            model.name.starts_with("measured")) {
            continue;
        }
        for (int i = 0; i < 2000; ++i) {
            const Vec3 wo = to_sphere(random.uniform2()), wi = to_sphere(random.uniform2());
            if (std::min(std::abs(wo.z), std::abs(wi.z)) < 0.05f) {
                continue;
            }
            const Rgb there = evaluate(model.bsdf, wo, wi) * (sqr(index_ratio(model.bsdf, wo, wi)) / std::abs(wi.z));
            const Rgb back = evaluate(model.bsdf, wi, wo) / std::abs(wo.z);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(there[c], back[c], 2e-3f * std::max(back[c], 1e-3f)) << model.name << ' ' << wo << wi;
            }
        }
    }
}

TEST(Bsdf, SpecularOnesHaveNoDensity) {
    const Vec3 wo = incidences()[1], mirror(-wo.x, -wo.y, wo.z);
    for (const Bsdf& bsdf : {Bsdf(ConductorBsdf{Rgb(0.2f), Rgb(3.9f), 0, 0}), Bsdf(DielectricBsdf{1.5f, 0, 0}),
                             Bsdf(DielectricBsdf{1, 0.5f, 0.5f})}) {
        EXPECT_TRUE(is_specular(bsdf));
        EXPECT_EQ(density(bsdf, wo, mirror), 0);
        EXPECT_TRUE(is_black(evaluate(bsdf, wo, mirror)));
        Pcg32 random(6);
        for (int i = 0; i < 100; ++i) {
            const auto s = sample(bsdf, wo, random);
            ASSERT_TRUE(s);
            EXPECT_TRUE(s->specular);
            if (s->direction.z > 0) {
                EXPECT_LT(length(s->direction - mirror), 1e-6f);
            }
        }
    }
}

TEST(Bsdf, AnIndexOfOneIsNotThere) {
    Pcg32 random(7);
    const Vec3 wo = incidences()[1];
    const auto s = sample(DielectricBsdf{1, 0.5f, 0.5f}, wo, random);
    ASSERT_TRUE(s);
    EXPECT_LT(length(s->direction + wo), 1e-6f);
    EXPECT_FLOAT_EQ(s->value.r / s->density, 1);
}

TEST(Microfacets, ProjectedAreaOfTheNormalsIsOne) {
    for (const FacetSlopes slopes : {FacetSlopes::ggx, FacetSlopes::beckmann}) {
        for (const auto& [ax, ay] : {std::pair{0.5f, 0.5f}, {0.8f, 0.3f}}) {
            const Microfacets facets(ax, ay, slopes);
            double projected = 0;
            constexpr int n = 1000;
            for (int i = 0; i < n; ++i) {
                for (int j = 0; j < n; ++j) {
                    const Vec3 m = direction_from_cosine((i + 0.5f) / n, (j + 0.5f) / n);
                    projected += facets.d(m) * m.z * 2 * pi / (n * n);
                }
            }
            EXPECT_NEAR(projected, 1, 1e-3);
        }
    }
}

// What is visible of the facets is what the macrosurface shows.
TEST(Microfacets, MaskingKeepsTheProjectedAreaOfWhatIsSeen) {
    for (const FacetSlopes slopes : {FacetSlopes::ggx, FacetSlopes::beckmann}) {
        const Microfacets facets(0.6f, 0.4f, slopes);
        for (const Vec3& w : {normalize(Vec3(0.3f, 0.2f, 1)), normalize(Vec3(-1, 0.5f, 0.4f))}) {
            double visible = 0;
            constexpr int n = 1000;
            for (int i = 0; i < n; ++i) {
                for (int j = 0; j < n; ++j) {
                    const Vec3 m = direction_from_cosine((i + 0.5f) / n, (j + 0.5f) / n);
                    visible += facets.g1(w) * facets.d(m) * std::max(dot(w, m), 0.0f) * 2 * pi / (n * n);
                }
            }
            // Beckmann's masking is a fit.
            EXPECT_NEAR(visible, w.z, slopes == FacetSlopes::ggx ? 1e-3 : 4e-3);
        }
    }
}

TEST(DirectionalAlbedo, IsExactForSmoothSurfaces) {
    for (const Vec3& wo : incidences()) {
        EXPECT_EQ(directional_albedo(LambertBsdf{Rgb(0.3f)}, wo), Rgb(0.3f));
        EXPECT_EQ(directional_albedo(DielectricBsdf{1.5f, 0, 0}, wo), Rgb(1));
        EXPECT_FLOAT_EQ(directional_albedo(ConductorBsdf{Rgb(0.2f), Rgb(3.9f), 0, 0}, wo).g,
                        fresnel_conductor(std::abs(wo.z), 0.2f, 3.9f));
    }
}

}  // namespace
}  // namespace wend
