// Guided flights through media as a made-up field tells them: unbiased whatever it says, and told apart from classical
// ones by their density_ratio.
#include <tests/medium/smooth_medium.h>
#include <tests/sampling/verdicts.h>
#include <wend/decision/guided_distance.h>
#include <wend/guide/region.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <vector>

namespace wend {
namespace {

constexpr float segment = 3.5f;
constexpr float share = 0.3f;

/// Slices across the x axis, each with light from everywhere.
class Slices {
public:
    struct Light {
        float brightness = 0;
        float confidence = 1;
        guide::NearLight near;
        template <class Phase>
        float in_scattered_from_afar(const Vec3&, const Phase&) const {
            return brightness;
        }
        template <class Phase>
        float in_scattered(const Vec3&, const Phase&) const {
            return brightness;
        }
    };
    struct Everywhere {
        float density(const Vec3&) const { return inv_4pi; }
    };
    struct Place {
        float brightness = 0;
        float fluence() const { return 4 * static_cast<float>(pi) * brightness; }
        Everywhere incident(const Vec3&) const { return {}; }
    };

    /// Slices end at increasing x; the first and the last one reach on.
    Slices(const std::vector<float>& ends, const std::vector<float>& brightness) : ends_(ends) {
        for (const float b : brightness) {
            lights_.emplace_back().brightness = b;
            places_.push_back({b});
        }
    }

    void set_lamp(const guide::NearLight& lamp) {
        for (Light& light : lights_) {
            light.near = lamp;
        }
    }

    bool is_trained() const { return !lights_.empty(); }
    const Light* scattered_light(const Vec3& p) const { return lights_.empty() ? nullptr : &lights_[slice_of(p.x)]; }
    float leaving(const Vec3& p, const Vec3& normal) const {
        return lights_.empty() ? 0.0f : lights_[slice_of(p.x)].brightness * (normal.x < 0 ? 2.0f : 1.0f);
    }
    const Place* find(const Vec3& p) const { return places_.empty() ? nullptr : &places_[slice_of(p.x)]; }

    /// For rays towards +x.
    template <class Visit>
    void walk(const Ray& ray, float t0, float t1, Visit&& visit, float /*finest*/ = 0) const {
        for (std::size_t i = slice_of(ray.at(t0).x); t0 < t1; ++i) {
            const float end = i < ends_.size() ? (ends_[i] - ray.origin.x) / ray.direction.x : t1;
            if (end > t0) {
                if (!visit(lights_[i], t0, std::min(end, t1))) {
                    return;
                }
                t0 = end;
            }
        }
    }

private:
    std::size_t slice_of(float x) const {
        return static_cast<std::size_t>(std::upper_bound(ends_.begin(), ends_.end(), x) - ends_.begin());
    }

    std::vector<float> ends_;
    std::vector<Light> lights_;
    std::vector<Place> places_;
};

static_assert(AdjointAlongRays<Slices>);

const Ray ray = test::ray_through_smooth_medium();

/// A lamp beside the ray that all of them take for near.
Slices with_lamp(Slices slices) {
    slices.set_lamp({ray.at(1.3f) + Vec3(0, 0.02f, 0.03f), 1e-4f, 0.5f, 1});
    return slices;
}

Slices uneven() {
    return {{-0.5f, 0.4f}, {0.2f, 5, 1}};
}

/// More than there is room for on the way.
Slices very_many() {
    std::vector<float> ends, brightness = {1};
    for (int i = 0; i < 220; ++i) {
        ends.push_back(-1.58f + 0.0115f * static_cast<float>(i));
        brightness.push_back(1 + 0.25f * static_cast<float>(i % 5));
    }
    return {ends, brightness};
}

HomogeneousMedium homogeneous(const Rgb& absorption, const Rgb& scattering) {
    return {absorption, scattering, Rgb(0), PhaseFunction(HenyeyGreenstein{0.5f})};
}

FlightStart start_with(const FlightEnd& end, const Rgb& throughput = Rgb(1)) {
    return {ray, segment, throughput, 0, end};
}

FlightEnd nothing(float emitted) {
    FlightEnd end;
    end.emitted = emitted;
    return end;
}

struct Case {
    const char* name;
    HomogeneousMedium medium;
    Slices field;
    DistanceGuiding guiding = DistanceGuiding::scatter_and_distance;
    Rgb throughput{1.0f};
    int samples = 3000000;

    friend void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
};

class Thickness {
public:
    explicit Thickness(const HomogeneousMedium& medium)
        : extinction_(medium.extinction()), scattering_(medium.scattering) {}

    double passed(double t, int c) const { return std::exp(-extinction_[c] * t); }
    /// What is scattered between two distances.
    double scattered(double from, double to, int c) const {
        return extinction_[c] > 0 ? scattering_[c] / extinction_[c] * (passed(from, c) - passed(to, c)) : 0.0;
    }

private:
    Rgb extinction_, scattering_;
};

class GuidedWeights : public testing::TestWithParam<Case> {};

TEST_P(GuidedWeights, AreUnbiasedInEveryBinAndChannel) {
    const Case& c = GetParam();
    const GuidedDistance distance(&c.field, &c.field, share, c.guiding);
    const FlightStart start = start_with(nothing(2), c.throughput);
    constexpr std::size_t bins = 3;
    std::array<std::array<Moments, 3>, bins + 2> means;
    Moments inverse_boost;
    Pcg32 random(1);
    bool finite = true;
    for (int i = 0; i < c.samples; ++i) {
        const float u = random.uniform();
        const Flight flight = distance.sample(c.medium, start, u, random);
        finite = finite && is_finite(flight.weight) && std::isfinite(flight.density_ratio) && flight.density_ratio > 0;
        inverse_boost.add(1 / flight.density_ratio);
        const auto bin =
            flight.scatters ? std::min(static_cast<std::size_t>(flight.distance / segment * bins), bins - 1) : bins;
        for (std::size_t k = 0; k < bins + 2; ++k) {
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const bool counts = k == bin || (k == bins + 1 && flight.scatters);
                means[k][channel].add(counts ? flight.weight[static_cast<int>(channel)] : 0);
            }
        }
    }
    EXPECT_TRUE(finite);
    EXPECT_TRUE(test::is_within_one_percent(inverse_boost, 1));
    const Thickness thickness(c.medium);
    for (std::size_t i = 0; i < 3; ++i) {
        const int channel = static_cast<int>(i);
        if (c.throughput[channel] == 0) {
            continue;  // what the walk carries there is 0, whatever the weight
        }
        SCOPED_TRACE(channel);
        for (std::size_t k = 0; k < bins; ++k) {
            const double from = segment * static_cast<double>(k) / bins, to = segment * (k + 1.0) / bins;
            const double expected = thickness.scattered(from, to, channel);
            EXPECT_TRUE(agrees(means[k][i], expected, 4, 1e-4))
                << k << ": " << means[k][i].mean() << ", standard error " << means[k][i].standard_error()
                << ", expected " << expected;
        }
        const double all = thickness.scattered(0, segment, channel);
        if (all > 0) {
            EXPECT_TRUE(test::is_within_one_percent(means[bins + 1][i], all, 1e-4));
        }
        EXPECT_TRUE(test::is_within_one_percent(means[bins][i], thickness.passed(segment, channel), 1e-4));
    }
}

const Rgb red_absorption(0.1f, 0.2f, 0.1f), blue_scattering(0.3f, 0.6f, 1.2f);
constexpr auto scatter_alone = DistanceGuiding::scatter_alone;

INSTANTIATE_TEST_SUITE_P(
    SlowGuidedDistance, GuidedWeights,
    testing::Values(Case{"homogeneous", homogeneous(Rgb(0.1f), Rgb(0.4f)), uneven()},
                    Case{"homogeneous_lamp", homogeneous(Rgb(0.1f), Rgb(0.4f)), with_lamp(uneven())},
                    Case{"homogeneous_many_slices_lamp", homogeneous(Rgb(0.1f), Rgb(0.4f)), with_lamp(very_many()),
                         DistanceGuiding::scatter_and_distance, Rgb(1), 2000000},
                    Case{"chromatic_lamp", homogeneous(red_absorption, blue_scattering), with_lamp(uneven())},
                    Case{"homogeneous_level", homogeneous(Rgb(0.1f), Rgb(0.4f)), uneven(), scatter_alone},
                    Case{"homogeneous_many_slices", homogeneous(Rgb(0.1f), Rgb(0.4f)), very_many(),
                         DistanceGuiding::scatter_and_distance, Rgb(1), 1500000},
                    Case{"homogeneous_dark", homogeneous(Rgb(0.1f), Rgb(0.4f)), {{0.1f}, {0, 0}}},
                    Case{"chromatic", homogeneous(red_absorption, blue_scattering), uneven()},
                    Case{"chromatic_level", homogeneous(red_absorption, blue_scattering), uneven(), scatter_alone,
                         Rgb(1, 0.5f, 2)},
                    Case{"chromatic_dark_channel", homogeneous(red_absorption, blue_scattering), uneven(),
                         DistanceGuiding::scatter_and_distance, Rgb(1, 1, 0)},
                    Case{"chromatic_clear_channel", homogeneous({0, 0.2f, 0.1f}, {0, 0.6f, 1.2f}), uneven()}),
    [](const auto& param_info) { return param_info.param.name; });

TEST(GuidedDistance, TheBoostIsDensityOverClassical) {
    // The weight of a classical flight through a grey medium is the albedo, or 1 at the end.
    const Slices field = uneven();
    const Medium medium = homogeneous(Rgb(0.2f), Rgb(0.6f));
    for (const auto guiding : {DistanceGuiding::scatter_alone, DistanceGuiding::scatter_and_distance}) {
        const GuidedDistance distance(&field, &field, share, guiding);
        Pcg32 random(2);
        float least = infinity, most = 0;
        for (int i = 0; i < 4000; ++i) {
            const float u = random.uniform();
            const Flight flight = distance.sample(medium, start_with(nothing(0.3f)), u, random);
            ASSERT_NEAR(flight.weight.g * flight.density_ratio, flight.scatters ? 0.75f : 1.0f, 2e-4f);
            ASSERT_GE(flight.density_ratio, share);
            least = std::min(least, flight.density_ratio);
            most = std::max(most, flight.density_ratio);
        }
        EXPECT_LT(least, 0.9f);
        EXPECT_GT(most, 1.02f);
    }
}

/// The density ratio of a flight to the end through grey fog that is equally bright everywhere, with light A ahead: α +
/// (1 - α) A / Z, with Z the light of the fog and what comes through.
float boost_at_end(float ahead) {
    const float passed = std::exp(-0.8f * segment), brightness = 2;
    return share + (1 - share) * ahead / (brightness * 0.75f * (1 - passed) + ahead * passed);
}

TEST(GuidedDistance, LooksAhead) {
    const Slices volume({}, {2}), surface({}, {7}), blank({}, {});
    const Medium medium = homogeneous(Rgb(0.2f), Rgb(0.6f));
    const auto density_ratio = [&](const Slices& surfaces, FlightEnd::Kind kind, const Vec3& normal) {
        const GuidedDistance distance(&surfaces, &volume, share, DistanceGuiding::scatter_and_distance);
        FlightEnd end = nothing(0.5f);
        end.kind = kind;
        end.position = ray.at(segment);
        end.normal = normal;
        Pcg32 random(3);
        for (;;) {
            const float u = random.uniform();
            if (const Flight flight = distance.sample(medium, start_with(end), u, random); !flight.scatters) {
                return flight.density_ratio;
            }
        }
    };
    using Kind = FlightEnd::Kind;
    const Vec3 front(1, 0, 0), back(-1, 0, 0);
    EXPECT_NEAR(density_ratio(surface, Kind::nothing, front), boost_at_end(0.5f), 1e-4f);
    EXPECT_NEAR(density_ratio(surface, Kind::surface, front), boost_at_end(7.5f), 1e-4f);
    EXPECT_NEAR(density_ratio(surface, Kind::surface, back), boost_at_end(14.5f), 1e-4f);
    EXPECT_NEAR(density_ratio(blank, Kind::surface, front), boost_at_end(0.5f), 1e-4f);
    EXPECT_NEAR(density_ratio(surface, Kind::interface, front), boost_at_end(2.5f), 1e-4f);
}

/// Whether flights are those of classical sampling, number for number.
bool is_classical(const Slices& field, const Medium& medium, float weight) {
    const GuidedDistance distance(&field, &field, share, DistanceGuiding::scatter_and_distance);
    FlightStart start = start_with(nothing(0.1f));
    start.weight = weight;
    Pcg32 guided(4), classical(4);
    for (int i = 0; i < 200; ++i) {
        const float u = guided.uniform();
        classical.uniform();
        const Flight a = distance.sample(medium, start, u, guided);
        const Flight b = ClassicalDistance().sample(medium, start, u, classical);
        if (a.scatters != b.scatters || a.distance != b.distance || a.weight != b.weight || a.density_ratio != 1) {
            return false;
        }
    }
    return true;
}

TEST(GuidedDistance, IsClassicalForHeavyWalksAndWhereNothingIsKnownOrScattered) {
    const Slices field = uneven(), blank({}, {});
    const Medium medium = homogeneous(Rgb(0.2f), Rgb(0.6f));
    EXPECT_TRUE(is_classical(blank, medium, 1));
    EXPECT_TRUE(is_classical(field, medium, weight_bound));
    EXPECT_FALSE(is_classical(field, medium, 0.9f * weight_bound));
    EXPECT_TRUE(is_classical(field, homogeneous(Rgb(0.8f), Rgb(0.0f)), 1)) << "nothing scatters";
}

TEST(GuidedDistance, NoFlightMakesAWalkTooHeavy) {
    const Slices field = uneven();
    const Medium medium = homogeneous(Rgb(0), Rgb(0.8f));
    const GuidedDistance distance(&field, &field, 0.01f, DistanceGuiding::scatter_and_distance);
    for (const float weight : {0.2f, 1.0f, 2.0f, 2.9f, 5.0f}) {
        FlightStart start = start_with(nothing(0));
        start.weight = weight;
        Pcg32 random(8);
        float heaviest = 0;
        for (int i = 0; i < 20000; ++i) {
            const float u = random.uniform();
            heaviest = std::max(heaviest, weight * distance.sample(medium, start, u, random).weight.g);
        }
        EXPECT_LE(heaviest, std::max(weight, weight_bound) * 1.0001f) << weight;
        EXPECT_GE(heaviest, std::max(0.9999f * weight, 0.9f * weight_bound)) << weight;
    }
}

TEST(GuidedDistance, IsClassicalInGrids) {
    EXPECT_TRUE(is_classical(uneven(), test::smooth_medium(Rgb(0.2f), Rgb(0.6f)), 1));
}

TEST(GuidedDistance, EmissionOfAHomogeneousMediumHasNoVariance) {
    const Slices field = uneven();
    const GuidedDistance distance(&field, &field, share, DistanceGuiding::scatter_and_distance);
    const HomogeneousMedium medium{Rgb(0.5f), Rgb(0.2f), Rgb(3), PhaseFunction()};
    Pcg32 random(5);
    for (int i = 0; i < 100; ++i) {
        const float u = random.uniform();
        EXPECT_EQ(distance.sample(medium, start_with(nothing(1)), u, random).emitted, emitted_along(medium, segment));
    }
}

TEST(GuidedDistance, ASegmentBeyondAnyScene) {
    const Slices field = uneven(), many = very_many();
    for (const Slices* slices : {&field, &many}) {
        for (const auto guiding : {DistanceGuiding::scatter_alone, DistanceGuiding::scatter_and_distance}) {
            const GuidedDistance distance(slices, slices, share, guiding);
            for (const Medium& medium :
                 {Medium(homogeneous(red_absorption, blue_scattering)),
                  Medium(homogeneous({0, 0.2f, 0.1f}, {0, 0.6f, 1.2f})), Medium(homogeneous(Rgb(0), Rgb(0))),
                  Medium(test::smooth_medium(red_absorption, blue_scattering))}) {
                FlightStart start = start_with(nothing(0.5f));
                start.length = 1e30f;
                Pcg32 random(6);
                for (int i = 0; i < 2000; ++i) {
                    const float u = random.uniform();
                    const Flight flight = distance.sample(medium, start, u, random);
                    ASSERT_TRUE(is_finite(flight.weight) && is_finite(flight.emitted) &&
                                std::isfinite(flight.density_ratio));
                    ASSERT_TRUE(!flight.scatters || flight.distance < 1e4f);
                }
            }
        }
    }
}

}  // namespace
}  // namespace wend
