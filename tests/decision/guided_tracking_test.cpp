// Tracking that knows what lies ahead: unbiased whatever it is told, and without noise of its own where that is right.
#include <tests/medium/smooth_medium.h>
#include <tests/sampling/verdicts.h>
#include <wend/decision/guided_tracking.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <ostream>
#include <vector>

namespace wend {
namespace {

constexpr float segment = 3.5f;
const Ray ray = test::ray_through_smooth_medium();

/// What tracking is told of the light.
struct Told {
    const char* name;
    std::vector<float> in_scattered;  ///< in equal parts of the segment
    float ahead;
    bool level = false;
};

struct Case {
    Told told;
    Rgb absorption, scattering;
    Rgb throughput{1.0f};
    int samples = 2500000;

    friend void PrintTo(const Case& c, std::ostream* out) { *out << c.told.name; }
};

class Tracker {
public:
    Tracker(const GridMedium& medium, const Told& told, float defensive_fraction, const Rgb& throughput = Rgb(1))
        : medium_(medium), told_(told), share_(defensive_fraction), start_{ray, segment, throughput, 1, {}} {}

    Flight fly(Pcg32& random) const {
        GuidedTracking tracking(medium_, start_, share_);
        const auto parts = static_cast<float>(told_.in_scattered.size());
        float part = 0;
        for (const float radiance : told_.in_scattered) {
            tracking.light_up_to(segment * ++part / parts, radiance);
        }
        return tracking.fly(told_.ahead, told_.level, random);
    }

    /// To where tracking looks.
    float reach() const { return GuidedTracking(medium_, start_, share_).reach(); }

private:
    const GridMedium& medium_;
    const Told& told_;
    float share_;
    FlightStart start_;
};

constexpr float share = 0.3f;

/// Means of weights in bins of distance, and of the weight of passes, in every channel.
class TrackedWeights : public testing::TestWithParam<Case> {
protected:
    static constexpr std::size_t bins = 3;
};

TEST_P(TrackedWeights, AreUnbiasedInEveryBinAndChannel) {
    const Case& c = GetParam();
    const GridMedium medium = test::smooth_medium(c.absorption, c.scattering);
    const Tracker tracker(medium, c.told, share, c.throughput);
    std::array<std::array<Moments, 3>, bins + 2> means;
    Moments inverse_boost;
    Pcg32 random(1);
    bool finite = true;
    for (int i = 0; i < c.samples; ++i) {
        const Flight flight = tracker.fly(random);
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
    // The classical density over that of the flights is a density too.
    EXPECT_TRUE(test::is_within_one_percent(inverse_boost, 1));
    const test::DensityAlong density(medium, ray, segment);
    for (std::size_t i = 0; i < 3; ++i) {
        const int channel = static_cast<int>(i);
        if (c.throughput[channel] == 0) {
            continue;  // what the walk carries there is 0, whatever the weight
        }
        SCOPED_TRACE(channel);
        const double sigma = medium.extinction()[channel];
        const auto passed = [&](double t) { return std::exp(-sigma * density.up_to(t)); };
        for (std::size_t k = 0; k < bins; ++k) {
            const double from = segment * static_cast<double>(k) / bins, to = segment * (k + 1.0) / bins;
            const double expected = c.scattering[channel] / sigma * (passed(from) - passed(to));
            if (expected < 1e-5) {
                continue;  // hardly any flight gets there
            }
            EXPECT_TRUE(agrees(means[k][i], expected, 4, 1e-4))
                << k << ": " << means[k][i].mean() << ", standard error " << means[k][i].standard_error()
                << ", expected " << expected;
        }
        EXPECT_TRUE(test::is_within_one_percent(means[bins + 1][i],
                                                c.scattering[channel] / sigma * (1 - passed(segment)), 1e-4));
        if (passed(segment) > 1e-5) {
            EXPECT_TRUE(test::is_within_one_percent(means[bins][i], passed(segment), 1e-4));
        }
    }
}

const std::vector<float> steps = {0.2f, 3, 0, 1, 30, 0.5f, 1};
const Rgb red_absorption(0.1f, 0.2f, 0.1f), blue_scattering(0.3f, 0.6f, 1.2f);

INSTANTIATE_TEST_SUITE_P(
    SlowGuidedTracking, TrackedWeights,
    testing::Values(Case{{"uneven", steps, 2}, Rgb(0.2f), Rgb(0.6f)},
                    Case{{"level", steps, 2, true}, Rgb(0.2f), Rgb(0.6f)},
                    Case{{"dark_medium", {0}, 1}, Rgb(0.2f), Rgb(0.6f)},
                    Case{{"dark_end", {1}, 0}, Rgb(0.2f), Rgb(0.6f)}, Case{{"all_dark", {0}, 0}, Rgb(0.2f), Rgb(0.6f)},
                    Case{{"deep_in_one_channel", steps, 2}, Rgb(0.1f, 0.2f, 1), Rgb(0.3f, 0.6f, 60)},
                    Case{{"chromatic", steps, 2}, red_absorption, blue_scattering},
                    Case{{"chromatic_level", steps, 2, true}, red_absorption, blue_scattering, Rgb(1, 0.5f, 2)},
                    Case{{"chromatic_dark_channel", steps, 0.3f}, red_absorption, blue_scattering, Rgb(1, 1, 0)}),
    [](const auto& param_info) { return param_info.param.told.name; });

TEST(GuidedTracking, LooksNoFurtherThanLightComesFrom) {
    const Told told{"", steps, 2};
    const GridMedium thin = test::smooth_medium(Rgb(0.2f), Rgb(0.6f));
    EXPECT_GT(Tracker(thin, told, share).reach(), 0.9f * segment);
    // Behind, flights are classical; that they are right is for one of the cases above to tell.
    const GridMedium deep = test::smooth_medium(Rgb(0.1f, 0.2f, 1), Rgb(0.3f, 0.6f, 60));
    EXPECT_LT(Tracker(deep, told, share).reach(), 0.9f * segment);
    Pcg32 random(5);
    for (int i = 0; i < 10000; ++i) {
        const Flight flight = Tracker(deep, told, share).fly(random);
        ASSERT_TRUE(flight.scatters ? flight.distance <= segment : flight.distance == segment);
    }
}

TEST(GuidedTracking, InUniformLightHasNoNoiseOfItsOwn) {
    const GridMedium medium = test::smooth_medium(Rgb(0), Rgb(1.5f));
    const Told uniform{"", {1}, 1};
    const Tracker tracker(medium, uniform, 0.01f);
    Pcg32 random(2);
    for (int i = 0; i < 10000; ++i) {
        const Flight flight = tracker.fly(random);
        ASSERT_NEAR(flight.weight.g, 1, 1e-4f);
        ASSERT_NEAR(flight.density_ratio, 1, 1e-4f);
    }
}

TEST(GuidedTracking, GoesWhereTheLightIs) {
    const GridMedium medium = test::smooth_medium(Rgb(0.2f), Rgb(0.6f));
    const auto scatters = [&](const Told& told, float from, float to) {
        const Tracker tracker(medium, told, 0.05f);
        Pcg32 random(3);
        int count = 0;
        for (int i = 0; i < 20000; ++i) {
            const Flight flight = tracker.fly(random);
            count += flight.scatters && flight.distance >= from && flight.distance < to;
        }
        return count / 20000.0;
    };
    const double classical = scatters({"", {1}, 1}, 0, segment);
    EXPECT_GT(scatters({"", {1}, 0}, 0, segment), 1.5 * classical);
    EXPECT_LT(scatters({"", {0}, 1}, 0, segment), 0.1 * classical);
    EXPECT_GT(scatters({"", {0.1f, 5}, 1}, segment / 2, segment), 1.3 * scatters({"", {1}, 1}, segment / 2, segment));
}

TEST(SlowGuidedTracking, EmissionIsTheLineIntegral) {
    for (const bool level : {false, true}) {
        for (const Rgb& scattering : {Rgb(0.5f), Rgb(0.1f, 0.5f, 1)}) {
            auto emitter = std::make_shared<GridEmission>();
            emitter->radiance = Rgb(1, 2, 3);
            emitter->field = test::smooth_grid(20);
            emitter->field_from_world = AffineMap(test::index_from_world(20));
            const GridMedium medium = test::smooth_medium(Rgb(0.5f), scattering, emitter);
            const test::DensityAlong density(medium, ray, segment);
            const Told told{"", steps, 2, level};
            const Tracker tracker(medium, told, share);
            std::array<Moments, 3> emitted;
            Pcg32 random(4);
            for (int i = 0; i < 1200000; ++i) {
                const Flight flight = tracker.fly(random);
                for (std::size_t c = 0; c < 3; ++c) {
                    emitted[c].add(flight.emitted[static_cast<int>(c)]);
                }
            }
            for (int c = 0; c < 3; ++c) {
                const double expected = density.integrate([&](double t, double tau) {
                    return 0.5 * emitter->at(ray.at(static_cast<float>(t)))[c] *
                           std::exp(-medium.extinction()[c] * tau);
                });
                EXPECT_TRUE(test::is_within_one_percent(emitted[static_cast<std::size_t>(c)], expected, 1e-4)) << c;
            }
        }
    }
}

TEST(GuidedTracking, AClearMediumIsPassed) {
    const GridMedium medium = test::smooth_medium(Rgb(0), Rgb(0));
    const Told told{"", {1}, 1};
    const Tracker tracker(medium, told, share);
    // The first number of the first generator is 0: no rate brings a collision then.
    constexpr std::uint64_t begins_with_zero = 1325953;
    ASSERT_EQ(Pcg32(begins_with_zero).uniform(), 0);
    for (std::uint64_t i = 0; i < 100; ++i) {
        Pcg32 random(begins_with_zero + i);
        const Flight flight = tracker.fly(random);
        EXPECT_FALSE(flight.scatters);
        EXPECT_EQ(flight.distance, segment);
        EXPECT_EQ(flight.weight, Rgb(1));
    }
}

}  // namespace
}  // namespace wend
