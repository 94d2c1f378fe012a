#include <tests/medium/smooth_medium.h>
#include <tests/sampling/verdicts.h>
#include <wend/decision/distance.h>
#include <wend/medium/transmittance.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <ostream>

namespace wend {
namespace {

constexpr float segment = 3.5f;

struct Case {
    const char* name;
    Medium medium;
    Rgb throughput;

    friend void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
};

Medium homogeneous(const Rgb& absorption, const Rgb& scattering, const Rgb& emission = Rgb(0)) {
    return HomogeneousMedium{absorption, scattering, emission, PhaseFunction()};
}

const Ray ray = test::ray_through_smooth_medium();

/// Optical thickness of channel c, at distances along the ray.
class Thickness {
public:
    explicit Thickness(const Medium& medium) {
        if (const auto* grid = std::get_if<GridMedium>(&medium)) {
            density_.emplace(*grid, ray, segment);
            extinction_ = grid->extinction();
            scattering_ = grid->scattering();
        } else {
            extinction_ = std::get<HomogeneousMedium>(medium).extinction();
            scattering_ = std::get<HomogeneousMedium>(medium).scattering;
        }
    }
    double up_to(double t, int c) const { return extinction_[c] * (density_ ? density_->up_to(t) : t); }

    /// ∫ scattering coefficient · transmittance · t^power dt over the segment.
    double scattered(int c, int power) const {
        const auto f = [&](double t, double density) {
            return scattering_[c] * std::exp(-extinction_[c] * density) * std::pow(t, power);
        };
        if (density_) {
            return density_->integrate(f);
        }
        constexpr int steps = 20000;
        double sum = 0;
        for (int i = 0; i < steps; ++i) {
            const double t = segment * (i + 0.5) / steps;
            sum += f(t, t);
        }
        return sum * segment / steps;
    }

private:
    std::optional<test::DensityAlong> density_;
    Rgb extinction_, scattering_;
};

Flight fly(const Medium& medium, const Rgb& throughput, Pcg32& random) {
    const float u = random.uniform();
    return ClassicalDistance().sample(medium, {ray, segment, throughput, 1, {}}, u, random);
}

/// P-value of the distances of collisions in a grey medium, and of their share, against extinctions `scale` times the
/// true ones.
double p_value_of_distances(const Medium& medium, double scale) {
    const Thickness thickness(medium);
    constexpr int samples = 100000, cells = 50;
    std::vector<std::uint64_t> observed(cells + 1);
    Pcg32 random(1);
    const double pass = std::exp(-scale * thickness.up_to(segment, 0));
    for (int i = 0; i < samples; ++i) {
        const Flight flight = fly(medium, Rgb(1), random);
        if (flight.scatters) {
            const double u = (1 - std::exp(-scale * thickness.up_to(flight.distance, 0))) / (1 - pass);
            ++observed[static_cast<std::size_t>(std::clamp(static_cast<int>(u * cells), 0, cells - 1))];
        } else {
            EXPECT_EQ(flight.distance, segment);
            ++observed.back();
        }
    }
    std::vector<double> expected(cells, samples * (1 - pass) / cells);
    expected.push_back(samples * pass);
    return chi_square_test(observed, expected).p_value;
}

TEST(Flight, LosesNoLightThatCameFromNoDistance) {
    Flight flight;
    pick_up(flight, Rgb(0.0f), 0);
    pick_up(flight, Rgb(2.0f), 0);
    pick_up(flight, Rgb(2.0f), 4);
    EXPECT_EQ(flight.emitted, Rgb(4.0f));
    EXPECT_EQ(flight.glow, 0.5f);
}

TEST(ClassicalDistance, CollisionsInGreyMediaFollowTheExtinction) {
    for (const Medium& medium :
         {homogeneous(Rgb(0.2f), Rgb(0.5f)), homogeneous(Rgb(0), Rgb(3)),
          Medium(test::smooth_medium(Rgb(0.5f), Rgb(1))), Medium(test::smooth_medium(Rgb(0), Rgb(8)))}) {
        EXPECT_GE(p_value_of_distances(medium, 1), test::passing);
        EXPECT_LT(p_value_of_distances(medium, 1.06), test::failing);
    }
}

TEST(ClassicalDistance, GreyWeightsAreTheAlbedo) {
    Pcg32 random(2);
    for (const Medium& medium :
         {homogeneous(Rgb(0.5f), Rgb(1.5f)), Medium(test::smooth_medium(Rgb(0.5f), Rgb(1.5f)))}) {
        for (int i = 0; i < 1000; ++i) {
            const Flight flight = fly(medium, Rgb(1), random);
            EXPECT_NEAR(flight.weight.g, flight.scatters ? 0.75f : 1.0f, 1e-5f);
        }
    }
}

/// Means of weight and weight times distance for collisions, and of the weight for passes, in every channel.
class Weights : public testing::TestWithParam<Case> {
protected:
    static constexpr int samples = 3000000;
    std::array<std::array<Moments, 3>, 3> measure() const {
        std::array<std::array<Moments, 3>, 3> means;
        Pcg32 random(3);
        for (int i = 0; i < samples; ++i) {
            const Flight flight = fly(GetParam().medium, GetParam().throughput, random);
            for (std::size_t c = 0; c < 3; ++c) {
                const double w = flight.weight[static_cast<int>(c)];
                means[0][c].add(flight.scatters ? w : 0);
                means[1][c].add(flight.scatters ? w * flight.distance : 0);
                means[2][c].add(flight.scatters ? 0 : w);
            }
        }
        return means;
    }
};

TEST_P(Weights, AreUnbiasedInEveryChannel) {
    const Thickness thickness(GetParam().medium);
    const auto means = measure();
    for (int c = 0; c < 3; ++c) {
        const auto i = static_cast<std::size_t>(c);
        if (GetParam().throughput[c] == 0) {
            continue;  // what the walk carries there is 0, whatever the weight
        }
        SCOPED_TRACE(c);
        EXPECT_TRUE(test::is_within_one_percent(means[0][i], thickness.scattered(c, 0), 1e-4));
        EXPECT_TRUE(test::is_within_one_percent(means[1][i], thickness.scattered(c, 1), 1e-4));
        EXPECT_TRUE(test::is_within_one_percent(means[2][i], std::exp(-thickness.up_to(segment, c)), 1e-4));
    }
}

INSTANTIATE_TEST_SUITE_P(
    ClassicalDistance, Weights,
    testing::Values(
        Case{"homogeneous", homogeneous(Rgb(0.1f, 0.2f, 0.05f), Rgb(0.3f, 0.4f, 0.8f)), Rgb(1)},
        Case{"homogeneous_uneven", homogeneous(Rgb(0.1f, 0.2f, 0.05f), Rgb(0.3f, 0.4f, 0.8f)), Rgb(1, 0.5f, 2)},
        Case{"homogeneous_one_channel", homogeneous(Rgb(0.1f, 0.2f, 0.05f), Rgb(0.3f, 0.4f, 0.8f)), Rgb(0, 1, 0)},
        Case{"grid", test::smooth_medium(Rgb(0.1f, 0.2f, 0.1f), Rgb(0.3f, 0.6f, 1.2f)), Rgb(1)},
        Case{"grid_uneven", test::smooth_medium(Rgb(0.1f, 0.2f, 0.1f), Rgb(0.3f, 0.6f, 1.2f)), Rgb(1, 0.5f, 2)},
        Case{"grid_dark_channel", test::smooth_medium(Rgb(0.1f, 0.2f, 0.1f), Rgb(0.3f, 0.6f, 1.2f)), Rgb(1, 1, 0)}),
    [](const auto& param_info) { return param_info.param.name; });

TEST(ClassicalDistance, AWeightWrongByOnePercentIsRejected) {
    const Medium medium = homogeneous(Rgb(0.1f), Rgb(0.3f, 0.4f, 0.8f));
    Pcg32 random(4);
    Moments moments;
    for (int i = 0; i < 1000000; ++i) {
        const Flight flight = fly(medium, Rgb(1), random);
        moments.add(flight.scatters ? 1.01 * flight.weight.g : 0);
    }
    EXPECT_FALSE(agrees(moments, Thickness(medium).scattered(1, 0), 4, 1e-4));
}

TEST(ClassicalDistance, AClearChannelAlwaysPasses) {
    Pcg32 random(5);
    for (const Medium& medium : {homogeneous(Rgb(0), Rgb(0)), Medium(test::smooth_medium(Rgb(0), Rgb(0)))}) {
        const Flight flight = fly(medium, Rgb(1), random);
        EXPECT_FALSE(flight.scatters);
        EXPECT_EQ(flight.distance, segment);
        EXPECT_EQ(flight.weight, Rgb(1));
    }
}

TEST(ClassicalDistance, WhatOnlyAbsorbsIsPassed) {
    const Rgb absorption(0.5f, 1, 2);
    Pcg32 random(8);
    const Medium clear = homogeneous(absorption, Rgb(0));
    for (int i = 0; i < 10; ++i) {
        const Flight flight = fly(clear, Rgb(1), random);
        EXPECT_FALSE(flight.scatters);
        EXPECT_EQ(flight.weight, transmittance(std::get<HomogeneousMedium>(clear), segment));
    }
    EXPECT_EQ(ClassicalDistance().pass_probability(clear, ray, segment), Rgb(1));

    const Medium grid = test::smooth_medium(absorption, Rgb(0));
    const Thickness thickness(grid);
    for (int i = 0; i < 10; ++i) {
        const Flight flight = fly(grid, Rgb(1), random);
        EXPECT_FALSE(flight.scatters);
        EXPECT_EQ(flight.distance, segment);
        for (int c = 0; c < 3; ++c) {
            const double expected = std::exp(-thickness.up_to(segment, c));
            EXPECT_NEAR(flight.weight[c], expected, 1e-4 * expected) << "no noise at all";
        }
    }
}

TEST(ClassicalDistance, EmissionOfAHomogeneousMediumHasNoVariance) {
    const Rgb absorption(0.5f, 1e-7f, 2), emission(3, 4, 5);
    Pcg32 random(6);
    for (int i = 0; i < 100; ++i) {
        const Flight flight = fly(homogeneous(absorption, Rgb(0), emission), Rgb(1), random);
        for (int c = 0; c < 3; ++c) {
            const double sigma = absorption[c];
            EXPECT_NEAR(flight.emitted[c], emission[c] * -std::expm1(-sigma * segment) / sigma,
                        1e-5 * flight.emitted[c]);
        }
    }
}

/// Emission in place: everywhere, or by a field of its own.
std::shared_ptr<const GridEmission> emission(bool with_field) {
    auto result = std::make_shared<GridEmission>();
    result->radiance = Rgb(1, 2, 3);
    if (with_field) {
        result->field = test::smooth_grid(20);
        result->field_from_world = AffineMap(test::index_from_world(20));
    }
    return result;
}

TEST(ClassicalDistance, EmissionOfAGridIsTheLineIntegral) {
    for (const bool with_field : {false, true}) {
        for (const Rgb& scattering : {Rgb(0.5f), Rgb(0.1f, 0.5f, 1)}) {
            const auto emitter = emission(with_field);
            const GridMedium grid = test::smooth_medium(Rgb(0.5f), scattering, emitter);
            const test::DensityAlong density(grid, ray, segment);
            const Medium medium = grid;
            std::array<Moments, 3> emitted;
            Pcg32 random(7);
            for (int i = 0; i < 800000; ++i) {
                const Flight flight = fly(medium, Rgb(1), random);
                for (std::size_t c = 0; c < 3; ++c) {
                    emitted[c].add(flight.emitted[static_cast<int>(c)]);
                }
            }
            for (int c = 0; c < 3; ++c) {
                const double expected = density.integrate([&](double t, double tau) {
                    return 0.5 * emitter->at(ray.at(static_cast<float>(t)))[c] * std::exp(-grid.extinction()[c] * tau);
                });
                EXPECT_TRUE(test::is_within_one_percent(emitted[static_cast<std::size_t>(c)], expected, 1e-4))
                    << c << with_field;
            }
        }
    }
}

TEST(ClassicalDistance, PassProbabilityIsTheTransmittanceWhereItIsKnown) {
    const ClassicalDistance distance;
    EXPECT_FLOAT_EQ(distance.pass_probability(homogeneous(Rgb(1), Rgb(2, 0, 0)), ray, 0.5f).r, std::exp(-1.5f));
    EXPECT_EQ(distance.pass_probability(Medium(test::smooth_medium(Rgb(1), Rgb(1))), ray, 0.5f), Rgb(1));
}

}  // namespace
}  // namespace wend
