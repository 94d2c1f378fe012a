#include <tests/sampling/verdicts.h>
#include <tests/support/chi_square_sphere.h>
#include <wend/decision/direction.h>
#include <wend/decision/roulette_splitting.h>
#include <wend/guide/mixture.h>
#include <wend/medium/phase.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wend {
namespace {

/// A phase function in a medium.
struct Volume {
    static constexpr bool in_volume = true;
    Vec3 before = normalize(Vec3(0.2f, -0.5f, 0.7f));
    HenyeyGreenstein phase{0.6f};

    float density(const Vec3& w) const { return phase.evaluate(dot(before, w)); }
    Rgb evaluate(const Vec3& w) const { return Rgb(density(w)); }
    std::optional<DirectionSample> sample(float, const Vec2& u) const {
        const Vec3 w = PhaseFunction(phase).sample(before, u);
        return DirectionSample{w, evaluate(w), density(w)};
    }
    AxialLobes lobes() const { return phase.lobes().around(before); }
    bool is_specular() const { return false; }
    bool is_guidable() const { return true; }
};

/// A coloured Lambertian surface.
struct Wall {
    static constexpr bool in_volume = false;
    Vec3 normal = normalize(Vec3(-0.3f, 0.4f, 0.8f));
    Rgb reflectance{0.8f, 0.5f, 0.2f};

    float density(const Vec3& w) const { return cosine_hemisphere_density(dot(normal, w)); }
    Rgb evaluate(const Vec3& w) const { return reflectance * density(w); }
    std::optional<DirectionSample> sample(float, const Vec2& u) const {
        const Vec3 w = Frame::from_z(normal).to_world(to_cosine_hemisphere(u));
        return density(w) > 0 ? std::optional(DirectionSample{w, evaluate(w), density(w)}) : std::nullopt;
    }
    AxialLobes lobes() const { return AxialLobes(); }
    bool is_specular() const { return false; }
    bool is_guidable() const { return true; }
};

/// A mirror with probability 0.4 over a Lambertian base, like a smooth coat.
struct Coat {
    static constexpr bool in_volume = false;
    Wall base;

    float density(const Vec3& w) const { return 0.6f * base.density(w); }
    Rgb evaluate(const Vec3& w) const { return base.evaluate(w); }
    std::optional<DirectionSample> sample(float u, const Vec2& u2) const {
        if (u < 0.4f) {
            return DirectionSample{base.normal, Rgb(0.3f), 0.4f, true};
        }
        auto s = base.sample(0, u2);
        if (s) {
            s->density *= 0.6f;
        }
        return s;
    }
    AxialLobes lobes() const { return AxialLobes(); }
    bool is_specular() const { return false; }
    bool is_guidable() const { return true; }
};

/// What a field would have learned: one lobe, wrong on purpose where the test says so.
struct LobeAdjoint {
    Vmf lobe;
    guide::VmfMixture incident(const Vec3&) const { return guide::VmfMixture(std::array{guide::WeightedVmf{1, lobe}}); }
    float fluence() const { return 1; }
    Rgb in_scattered(const guide::MixtureProduct& product) const { return Rgb(product.integral()); }
    float defensive_fraction() const { return share; }
    float share = 0.25f;
};

struct LobeField {
    std::optional<LobeAdjoint> adjoint;
    const LobeAdjoint* find(const Vec3&) const { return adjoint ? &*adjoint : nullptr; }
};

const Vec3 here(1, 2, 3);
/// CausticLobes that have nothing to do with what there is.
const CausticMap caustics = [] {
    std::vector<CausticLobe> around;
    Pcg32 random(9);
    for (int i = 0; i < 30; ++i) {
        const Vec3 towards = i % 3 > 0 ? Vec3(0.3f, 0.9f, 0.4f) : Vec3(0.2f, -0.4f, 0.9f);
        const Vec3 moved(random.uniform(), random.uniform(), random.uniform());
        around.push_back({here + moved * 0.1f, normalize(towards + moved * 0.3f), 2, Rgb(0.2f)});
    }
    return CausticMap(around);
}();
const LobeField wrong{LobeAdjoint{{normalize(Vec3(-1, 0.5f, 0.2f)), 6}}};
const LobeField nothing{};
constexpr float defensive_fraction = 0.3f;

/// An incident radiance with which nothing above is in proportion.
double radiance(const Vec3& w) {
    return 1 + 0.8 * w.x + 2 * std::max(0.0f, w.y) * w.z * w.z;
}

/// ∫ f L over the sphere, by midpoints in cosine and azimuth.
template <class F>
Rgb integral_of(const F& f) {
    constexpr int n = 1500;
    std::array<double, 3> sum{};
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const Vec3 w = to_sphere({(static_cast<float>(i) + 0.5f) / n, (static_cast<float>(j) + 0.5f) / n});
            const Rgb value = f.evaluate(w);
            for (int c = 0; c < 3; ++c) {
                sum[static_cast<std::size_t>(c)] += value[c] * radiance(w);
            }
        }
    }
    const double scale = 4 * pi / (static_cast<double>(n) * n);
    return {static_cast<float>(sum[0] * scale), static_cast<float>(sum[1] * scale), static_cast<float>(sum[2] * scale)};
}

/// Means of weight · L; specular samples are left out.
template <class Distribution>
std::array<Moments, 3> estimate(const Distribution& distribution, int samples = 2500000) {
    std::array<Moments, 3> moments;
    Pcg32 random(1);
    for (int i = 0; i < samples; ++i) {
        const float u = random.uniform();
        const auto s = distribution.sample(u, random.uniform2());
        for (std::size_t c = 0; c < 3; ++c) {
            moments[c].add(s && !s->specular ? s->weight()[static_cast<int>(c)] * radiance(s->direction) : 0);
        }
    }
    return moments;
}

template <class F>
void expect_unbiased(const F& f) {
    const Rgb expected = integral_of(f);
    const auto classical = estimate(ClassicalDirection().at(here, f));
    const auto guided = estimate(GuidedDirection(&wrong, &wrong, defensive_fraction).at(here, f));
    const auto by_caustics = estimate(GuidedDirection(&nothing, &nothing, {}, &caustics, &caustics).at(here, f));
    const auto by_all = estimate(GuidedDirection(&wrong, &wrong, defensive_fraction, &caustics, &caustics).at(here, f));
    for (int c = 0; c < 3; ++c) {
        EXPECT_TRUE(test::is_within_one_percent(classical[static_cast<std::size_t>(c)], expected[c], 1e-4));
        EXPECT_TRUE(test::is_within_one_percent(guided[static_cast<std::size_t>(c)], expected[c], 1e-4));
        EXPECT_TRUE(test::is_within_one_percent(by_caustics[static_cast<std::size_t>(c)], expected[c], 1e-4));
        EXPECT_TRUE(test::is_within_one_percent(by_all[static_cast<std::size_t>(c)], expected[c], 1e-4));
    }
}

TEST(SlowDirection, GuidedAndClassicalHaveTheSameMean) {
    expect_unbiased(Volume{});
    expect_unbiased(Wall{});
    expect_unbiased(Coat{});
}

TEST(Direction, AWeightByTheWrongDensityIsRejected) {
    const Volume f;
    const auto guided = GuidedDirection(&wrong, &wrong, defensive_fraction).at(here, f);
    Pcg32 random(1);
    Moments moments;
    for (int i = 0; i < 100000; ++i) {
        const float u = random.uniform();
        const auto s = guided.sample(u, random.uniform2());
        moments.add(s ? s->value.r / f.density(s->direction) * radiance(s->direction) : 0);
    }
    EXPECT_FALSE(agrees(moments, integral_of(f).r, 4, 1e-4));
}

template <class Distribution>
test::SphereTest direction_test(const Distribution& distribution, const test::DirectionDensity& density) {
    return test::chi_square_sphere(
        [&](Pcg32& random) -> std::optional<Vec3> {
            const float u = random.uniform();
            const auto s = distribution.sample(u, random.uniform2());
            return s && !s->specular ? std::optional(s->direction) : std::nullopt;
        },
        density);
}

TEST(Direction, GuidedSamplesFollowTheirDensity) {
    const GuidedDirection guided(&wrong, &wrong, defensive_fraction);
    const Volume volume;
    const auto in_volume = guided.at(here, volume);
    EXPECT_TRUE(test::follows_density(direction_test(in_volume, [&](const Vec3& w) { return in_volume.density(w); }),
                                      "guided_volume", 3));
    // Directions below a wall are drawn by the lobe, but are no samples.
    const Wall wall;
    const auto on_wall = guided.at(here, wall);
    const auto above = [&](const auto& d, const Vec3& w) { return dot(wall.normal, w) > 0 ? d.density(w) : 0.0f; };
    EXPECT_TRUE(test::follows_density(direction_test(on_wall, [&](const Vec3& w) { return above(on_wall, w); }),
                                      "guided_wall", 3));
    const Coat coat;
    const auto on_coat = guided.at(here, coat);
    EXPECT_TRUE(test::follows_density(direction_test(on_coat, [&](const Vec3& w) { return above(on_coat, w); }),
                                      "guided_coat", 3));
}

TEST(Direction, SamplesAmongGlintsFollowTheirDensity) {
    const Volume volume;
    const GuidedDirection all(&wrong, &wrong, defensive_fraction, &caustics, &caustics);
    const auto in_volume = all.at(here, volume);
    EXPECT_TRUE(test::follows_density(direction_test(in_volume, [&](const Vec3& w) { return in_volume.density(w); }),
                                      "caustics_volume", 3));
    const Wall wall;
    const auto alone = GuidedDirection(&nothing, &nothing, {}, &caustics, &caustics).at(here, wall);
    const auto above = [&](const Vec3& w) { return dot(wall.normal, w) > 0 ? alone.density(w) : 0.0f; };
    EXPECT_TRUE(test::follows_density(direction_test(alone, above), "caustics_wall", 3));
}

TEST(Direction, NoDirectionMakesAWalkTooHeavy) {
    const Volume f;
    for (const CausticMap* known : {static_cast<const CausticMap*>(nullptr), &caustics}) {
        const GuidedDirection guide(&wrong, &wrong, 0.01f, known, known);
        for (const float weight : {0.2f, 1.0f, 2.0f, 2.9f, 3.0f, 5.0f}) {
            SCOPED_TRACE(testing::Message() << "weight " << weight << (known ? ", caustics" : ""));
            const auto distribution = guide.at(here, f, weight);
            Pcg32 random(7);
            float heaviest = 0;
            for (int i = 0; i < 20000; ++i) {
                const float u = random.uniform();
                const auto s = distribution.sample(u, random.uniform2());
                ASSERT_TRUE(s);
                heaviest = std::max(heaviest, weight * s->weight().r);
            }
            EXPECT_LE(heaviest, std::max(weight, weight_bound) * 1.0001f);
            EXPECT_GE(heaviest, 0.9f * weight_bound);
        }
        const Vec3 against = -wrong.adjoint->lobe.mean;
        EXPECT_LT(guide.at(here, f).density(against), 0.011f * f.density(against)) << "of unknown weight";
    }
}

TEST(Direction, AnotherClassicalShareIsRejected) {
    const Volume f;
    const auto actual = GuidedDirection(&wrong, &wrong, defensive_fraction).at(here, f);
    const auto claimed = GuidedDirection(&wrong, &wrong, 0.33f).at(here, f);
    EXPECT_LT(direction_test(actual, [&](const Vec3& w) { return claimed.density(w); }).result.p_value, test::failing);
}

TEST(Direction, SampleReportsValueAndDensityOfItsDirection) {
    const auto check = [&](const auto& f, const GuidedDirection<LobeField>& guided, float least_share) {
        const auto distribution = guided.at(here, f);
        Pcg32 random(2);
        for (int i = 0; i < 2000; ++i) {
            const float u = random.uniform();
            const auto s = distribution.sample(u, random.uniform2());
            if (s && !s->specular) {
                EXPECT_FLOAT_EQ(s->density, distribution.density(s->direction));
                EXPECT_FLOAT_EQ(s->value.g, f.evaluate(s->direction).g);
                EXPECT_LE(s->weight().g * least_share * f.density(s->direction), f.evaluate(s->direction).g * 1.0001f);
            }
        }
    };
    const GuidedDirection guided(&wrong, &wrong, defensive_fraction);
    check(Volume{}, guided, defensive_fraction);
    check(Wall{}, guided, defensive_fraction);
    check(Coat{}, guided, defensive_fraction);
    // CausticLobes never have more than a quarter.
    const GuidedDirection among_caustic_lobes(&wrong, &wrong, defensive_fraction, &caustics, &caustics);
    check(Volume{}, among_caustic_lobes, 0.75f * defensive_fraction);
    check(Wall{}, among_caustic_lobes, 0.75f * defensive_fraction);
    check(Coat{}, among_caustic_lobes, 0.75f * defensive_fraction);
}

TEST(Direction, TheAdjointChoosesTheShareUnlessOneIsGiven) {
    const Volume f;
    const auto own = GuidedDirection(&wrong, &wrong).at(here, f);
    const auto same = GuidedDirection(&wrong, &wrong, LobeAdjoint().share).at(here, f);
    const auto other = GuidedDirection(&wrong, &wrong, defensive_fraction).at(here, f);
    const Vec3 w = normalize(Vec3(1, 1, 0.5f));
    EXPECT_EQ(own.density(w), same.density(w));
    EXPECT_NE(own.density(w), other.density(w));
}

TEST(Direction, SamplesTellWhatTheirDensityIsMixedOf) {
    const Volume f;
    const auto guided = GuidedDirection(&wrong, &wrong, defensive_fraction).at(here, f);
    Pcg32 random(5);
    for (int i = 0; i < 100; ++i) {
        const float u = random.uniform();
        const Vec2 u2 = random.uniform2();
        const auto s = guided.sample(u, u2);
        ASSERT_TRUE(s);
        EXPECT_EQ(s->classical_density, f.density(s->direction));
        EXPECT_FLOAT_EQ(s->density,
                        defensive_fraction * s->classical_density + (1 - defensive_fraction) * s->guided_density);
        const auto alone = ClassicalDirection().at(here, f).sample(u, u2);
        EXPECT_EQ(alone->guided_density, 0);
    }
}

TEST(Direction, TheMirrorOfACoatKeepsItsWeight) {
    const Coat coat;
    const auto distribution = GuidedDirection(&wrong, &wrong, defensive_fraction).at(here, coat);
    Pcg32 random(3);
    Moments mirror;
    for (int i = 0; i < 4000000; ++i) {
        const float u = random.uniform();
        const auto s = distribution.sample(u, random.uniform2());
        mirror.add(s && s->specular ? s->weight().r : 0);
    }
    EXPECT_TRUE(test::is_within_one_percent(mirror, 0.3));
}

TEST(Direction, WhereNothingIsKnownGuidedIsClassical) {
    const Volume f;
    const auto guided = GuidedDirection(&nothing, &nothing, defensive_fraction).at(here, f);
    const auto classical = ClassicalDirection().at(here, f);
    Pcg32 random(4);
    for (int i = 0; i < 100; ++i) {
        const float u = random.uniform();
        const Vec2 u2 = random.uniform2();
        EXPECT_EQ(guided.sample(u, u2)->direction, classical.sample(u, u2)->direction);
        EXPECT_EQ(guided.sample(u, u2)->density, classical.sample(u, u2)->density);
    }
}

TEST(Direction, AHeavyWalkIsUnguidedButKnowsWhatToExpect) {
    const Volume f;
    const GuidedDirection guide(&wrong, &wrong, defensive_fraction);
    const auto light = guide.at(here, f, 0.99f * weight_bound);
    const auto heavy = guide.at(here, f, weight_bound);
    const auto classical = ClassicalDirection().at(here, f);
    ASSERT_TRUE(light.in_scattered() && heavy.in_scattered());
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ((*heavy.in_scattered())[c], (*light.in_scattered())[c]);
    }
    Pcg32 random(6);
    for (int i = 0; i < 100; ++i) {
        const float u = random.uniform();
        const Vec2 u2 = random.uniform2();
        const auto s = heavy.sample(u, u2);
        ASSERT_TRUE(s);
        EXPECT_EQ(s->direction, classical.sample(u, u2)->direction);
        EXPECT_EQ(s->density, classical.sample(u, u2)->density);
        EXPECT_EQ(s->density_ratio, 1);
        EXPECT_NE(light.density(s->direction), s->density);
    }
}

TEST(Direction, SurfacesAndVolumesHaveAFieldEach) {
    const Wall wall;
    const Volume volume;
    const Vec3 w = wall.normal;
    EXPECT_EQ(GuidedDirection(&nothing, &wrong, 0.5f).at(here, wall).density(w), wall.density(w));
    EXPECT_NE(GuidedDirection(&nothing, &wrong, 0.5f).at(here, volume).density(w), volume.density(w));
}

}  // namespace
}  // namespace wend
