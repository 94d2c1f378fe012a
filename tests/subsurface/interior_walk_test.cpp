// Guided interior walks in a dense medium: directions and distances follow their densities, and weights their
// integrand.
#include <tests/support/chi_square_sphere.h>
#include <wend/medium/transmittance.h>
#include <wend/planar/discrete_mode.h>
#include <wend/stats/moments.h>
#include <wend/stats/significance.h>
#include <wend/subsurface/half_space_mode.h>
#include <wend/subsurface/interior_walk.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

HalfSpaceMode mode_of(double albedo, float g) {
    std::vector<double> moments;
    for (int l = 0; l < 200; ++l) {
        moments.push_back(HenyeyGreenstein{g}.moment(l));
    }
    const DiscreteMode mode = discrete_mode(albedo, moments);
    return {mode.k, mode.albedo, mode.source};
}

/// Three channels that differ in extinction and albedo; walks may head for lamps.
InteriorGuide chromatic_guide(float g, bool lit = false) {
    InteriorGuide guide;
    guide.medium = {{0.1f, 0.4f, 1.0f}, {4.0f, 3.0f, 2.5f}, Rgb(0.0f), PhaseFunction(HenyeyGreenstein{g})};
    for (int c = 0; c < 3; ++c) {
        const double albedo = guide.medium.scattering[c] / (guide.medium.extinction()[c]);
        guide.modes.push_back({HalfSpaceMode(), mode_of(0.5 * (1 + albedo), g), mode_of(albedo, g)});
    }
    guide.defensive_fraction = 0.25f;
    guide.heads_for_emitters = lit;
    return guide;
}

/// The states that a guide's media and lights can put it into.
enum class State { usual, lit, lossless, lossless_channel, clear_channel, unlit, unguided, no_decay };
constexpr State states[] = {State::usual,         State::lit,   State::lossless, State::lossless_channel,
                            State::clear_channel, State::unlit, State::unguided, State::no_decay};

InteriorGuide guide_in(State state, float g) {
    InteriorGuide guide = chromatic_guide(g, state == State::lit || state == State::unlit);
    const auto set_medium = [&](const Rgb& absorption, const Rgb& scattering) {
        guide.medium.absorption = absorption;
        guide.medium.scattering = scattering;
        guide.modes = half_space_modes(guide.medium);
    };
    switch (state) {
        case State::lossless:
            set_medium(Rgb(0.0f), Rgb(3.0f));
            break;
        case State::lossless_channel:
            set_medium({0, 0.4f, 1}, {4, 3, 2.5f});
            break;
        case State::clear_channel:
            set_medium({0, 0.4f, 1}, {0, 3, 2.5f});
            break;
        case State::unguided:
            guide.defensive_fraction = 1;
            break;
        case State::no_decay:
            for (auto& of_channel : guide.modes) {
                of_channel.assign(3, of_channel.front());
            }
            break;
        default:
            break;
    }
    return guide;
}

const Vec3 first_normal = normalize(Vec3(0.3f, -0.5f, 0.8f));
const Vec3 second_normal = normalize(Vec3(-1, 0.2f, 0.1f));
const Vec3 arrival = normalize(Vec3(0.2f, 0.9f, -0.3f));

const std::vector<BoundaryEmitter> lamps = [] {
    const Vmf narrow{normalize(Vec3(-0.8f, 0.5f, 0.2f)), 60}, wide{normalize(Vec3(-0.5f, -0.6f, 0.3f)), 5};
    return std::vector<BoundaryEmitter>{{narrow, 0.9f, 4, vmf_peak(narrow.kappa)},
                                        {wide, 0.5f, 2, vmf_peak(wide.kappa)}};
}();

InteriorWalk begin(const InteriorGuide& guide) {
    InteriorWalk walk;
    walk.enter(guide, {0.5f, 0.3f, 0.2f});
    walk.aim(first_normal, 0.5f);
    if (walk.heads_for_emitters()) {
        walk.aim(EmitterView{lamps, 0.2f, {0.3f, 0.2f, 0.1f}});
    }
    walk.head(arrival);
    return walk;
}

class InteriorStay : public testing::TestWithParam<float> {};

class InteriorMixture : public testing::TestWithParam<std::tuple<float, State>> {
protected:
    float g() const { return std::get<0>(GetParam()); }
    InteriorGuide guide() const { return guide_in(std::get<1>(GetParam()), g()); }
};

TEST_P(InteriorStay, ModesDrawDirectionsInProportionToTheirLight) {
    const float g = GetParam();
    const PhaseFunction phase(HenyeyGreenstein{g});
    const HalfSpaceMode mode = mode_of(0.9, g);
    int number = 0;
    for (const Vec3& before : {arrival, first_normal, -first_normal}) {
        const auto sample = [&](Pcg32& random) {
            return std::optional<Vec3>(mode.sample(phase, before, first_normal, random));
        };
        const auto density = [&](const Vec3& w) {
            return static_cast<double>(phase.evaluate(dot(before, w)) * mode.radiance(dot(w, first_normal)) /
                                       mode.source(dot(before, first_normal)));
        };
        const std::string name = "half_space_mode" + std::to_string(number++) + "_" + std::to_string(g);
        EXPECT_TRUE(test::follows_density(test::test_direction_sampler(sample, density), name, 9));
        const auto wrong = [&](const Vec3& w) { return static_cast<double>(phase.evaluate(dot(before, w))); };
        EXPECT_LT(test::test_direction_sampler(sample, wrong).result.p_value, 1e-6);
    }
}

// Whatever can be asked of a medium: no decay is no reason to turn.
TEST_P(InteriorStay, ModesOfEveryLevelDrawDirectionsOfTheirDensity) {
    const float g = GetParam();
    const PhaseFunction phase(HenyeyGreenstein{g});
    for (const double albedo : {1.0, 0.999, 0.9, 0.3}) {
        const std::vector<HalfSpaceMode> modes = half_space_modes(albedo, phase);
        for (const std::size_t level : {std::size_t{0}, modes.size() / 2, modes.size() - 1}) {
            const HalfSpaceMode& mode = modes[level];
            const auto sample = [&](Pcg32& random) {
                return std::optional<Vec3>(mode.sample(phase, arrival, first_normal, random));
            };
            const auto density = [&](const Vec3& w) {
                return static_cast<double>(phase.evaluate(dot(arrival, w)) * mode.radiance(dot(w, first_normal)) /
                                           mode.source(dot(arrival, first_normal)));
            };
            const std::string name = "half_space_mode" + std::to_string(albedo) + "_" + std::to_string(level);
            EXPECT_TRUE(test::follows_density(test::test_direction_sampler(sample, density), name, 60)) << g;
        }
    }
}

TEST_P(InteriorMixture, DirectionsFollowTheirDensity) {
    const InteriorGuide mixture = guide();
    InteriorWalk walk = begin(mixture);
    if (std::get<1>(GetParam()) == State::unlit) {
        walk.aim(EmitterView{{}, 0.2f, Rgb(0.0f)});
    }
    Pcg32 random(1);
    ASSERT_TRUE(walk.fly(infinity, walk.draw_distance(0.7f)).flight.scatters);
    const InteriorWalk::Directions directions(walk, arrival, random);
    const auto sample = [&](Pcg32& numbers) -> std::optional<Vec3> {
        const float u = numbers.uniform();
        const auto s = directions.sample(u, numbers.uniform2());
        EXPECT_FLOAT_EQ(s->density, directions.density(s->direction));
        return s->direction;
    };
    EXPECT_TRUE(test::follows_density(
        test::test_direction_sampler(sample, [&](const Vec3& w) { return static_cast<double>(directions.density(w)); }),
        "interior_walk_" + std::to_string(g()), 24));
}

/// Sums over a walk of some collisions and what then passes `length`: unbiased estimates of the same for each channel,
/// whatever draws the walk.
struct Estimates {
    std::array<Moments, 3> collided, passed;
    Moments relative;  // of guided sampling: its mean is 1
};

Estimates estimate(const InteriorGuide& guide, float bias = 1) {
    Estimates e;
    Pcg32 random(7);
    for (int i = 0; i < 400000; ++i) {
        InteriorWalk walk = begin(guide);
        Vec3 before = arrival;
        Rgb weight(1.0f);
        float shape = 1;
        const InteriorFlight first = walk.fly(0.8f, walk.draw_distance(random.uniform()));
        weight *= first.flight.weight;
        if (first.flight.scatters) {
            walk.aim(second_normal, 1);
            const InteriorWalk::Directions directions(walk, before, random);
            const float u = random.uniform();
            const auto s = directions.sample(u, random.uniform2());
            weight *= s->weight() * bias;
            shape = 1 + dot(s->direction, second_normal);
            walk.turn(directions, s->direction);
            const InteriorFlight second = walk.fly(0.5f, walk.draw_distance(random.uniform()));
            weight *= second.flight.weight;
            e.relative.add(walk.relative_densities()[1]);
            for (std::size_t c = 0; c < 3; ++c) {
                const double value = weight[static_cast<int>(c)] * shape;
                e.collided[c].add(second.flight.scatters ? value : 0);
                e.passed[c].add(second.flight.scatters ? 0 : value);
            }
        } else {
            e.relative.add(walk.relative_densities()[1]);
            for (std::size_t c = 0; c < 3; ++c) {
                e.collided[c].add(0);
                e.passed[c].add(0);
            }
        }
    }
    return e;
}

TEST_P(InteriorMixture, WeightsAreIntegrandOverDensity) {
    const InteriorGuide mixture = guide();
    const Estimates e = estimate(mixture);
    const Estimates biased = estimate(mixture, 1.03f);
    const Rgb extinction = mixture.medium.extinction();
    int noticed = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto channel = static_cast<int>(c);
        const double sigma = extinction[channel];
        const double albedo = sigma > 0 ? mixture.medium.scattering[channel] / sigma : 0;
        // The mean of 1 + w · n over the phase function is 1 + g (before · n).
        const double shape = 1 + g() * dot(arrival, second_normal);
        const double once = albedo * -std::expm1(-sigma * 0.8) * shape;
        const double collided = once * albedo * -std::expm1(-sigma * 0.5);
        const double passed = once * std::exp(-sigma * 0.5);
        EXPECT_TRUE(agrees(e.collided[c], collided, 4, 1e-5)) << e.collided[c].mean() << " expected " << collided;
        EXPECT_TRUE(agrees(e.passed[c], passed, 4, 1e-5)) << e.passed[c].mean() << " expected " << passed;
        noticed += collided > 0 && !agrees(biased.collided[c], collided, 4, 1e-5);
        noticed += passed > 0 && !agrees(biased.passed[c], passed, 4, 1e-5);
    }
    EXPECT_GE(noticed, std::get<1>(GetParam()) == State::clear_channel ? 2 : 4) << "a bias of 3 % must be seen";
    EXPECT_TRUE(agrees(e.relative, std::get<1>(GetParam()) == State::unguided ? 0 : 1, 4, 1e-5)) << e.relative.mean();
}

INSTANTIATE_TEST_SUITE_P(MeanCosines, InteriorStay, testing::Values(0.0f, 0.8f, -0.5f));
INSTANTIATE_TEST_SUITE_P(MeanCosines, InteriorMixture,
                         testing::Combine(testing::Values(0.0f, 0.8f, -0.5f), testing::ValuesIn(states)));

TEST_P(InteriorStay, ConnectionsToLampsFollowTheirDensity) {
    InteriorGuide guide = chromatic_guide(GetParam(), true);
    for (const float depth : {0.05f, 0.4f, 1.0f}) {
        guide.connects_at_boundary = true;
        InteriorWalk walk = begin(guide);
        Pcg32 random(1);
        walk.aim(EmitterView{lamps, depth, {0.3f, 0.2f, 0.1f}});
        const InteriorWalk::Directions directions(walk, arrival, random);
        const auto sample = [&](Pcg32&) { return directions.sample_emitters(); };
        const auto density = [&](const Vec3& w) { return static_cast<double>(directions.emitter_density(w)); };
        EXPECT_TRUE(
            test::follows_density(test::test_direction_sampler(sample, density),
                                  "interior_emitters_" + std::to_string(depth) + "_" + std::to_string(GetParam()), 9));
        const auto wrong = [&](const Vec3& w) { return 1.2 * density(w); };
        EXPECT_LT(test::test_direction_sampler(sample, wrong).result.p_value, 1e-6);

        guide.connects_at_boundary = false;
        const InteriorWalk::Directions others(walk, arrival, random);
        EXPECT_FALSE(others.sample_emitters());
        EXPECT_EQ(others.emitter_density(lamps[0].lobe.mean), 0);
    }
}

TEST(InteriorWalk, HeadsForLampsAndFliesOutToThem) {
    InteriorGuide guide = chromatic_guide(0, true);
    guide.defensive_fraction = 0.03f;
    InteriorWalk walk;
    walk.enter(guide, Rgb(1.0f / 3));
    walk.aim(second_normal);
    walk.aim(EmitterView{lamps, 0.05f, Rgb(0.01f)});
    walk.head(arrival);
    Pcg32 random(2);
    ASSERT_TRUE(walk.fly(infinity, walk.draw_distance(0.5f)).flight.scatters);
    const Vec3& towards = lamps[0].lobe.mean;
    const InteriorWalk::Directions directions(walk, arrival, random);
    EXPECT_GT(directions.density(towards), 0.3f * lamps[0].lobe.density(towards));
    walk.turn(directions, towards);
    EXPECT_GT(walk.pass(10), 0.8f);
}

TEST(InteriorWalk, NoWeightExceedsTheClassicalOneOverItsShare) {
    const InteriorGuide guide = chromatic_guide(0.5f);
    Pcg32 random(3);
    for (int i = 0; i < 2000; ++i) {
        InteriorWalk walk = begin(guide);
        Vec3 before = arrival;
        for (int step = 0; step < 50; ++step) {
            walk.fly(infinity, walk.draw_distance(random.uniform()));
            const InteriorWalk::Directions directions(walk, before, random);
            const float u = random.uniform();
            const Vec3 w = directions.sample(u, random.uniform2())->direction;
            walk.turn(directions, w);
            before = w;
            const auto [classical, guided] = walk.relative_densities();
            ASSERT_LE(classical * guide.defensive_fraction, 1.0001f);
            ASSERT_LE(guided * (1 - guide.defensive_fraction), 1.0001f);
        }
    }
}

TEST(InteriorWalk, SurvivesWhileTheGuideExpectsLight) {
    const InteriorGuide guide = chromatic_guide(0);
    InteriorWalk walk = begin(guide);
    EXPECT_EQ(walk.survival(0.01f), 1);
    // Straight away from the normal is where nothing is expected, and classical walks do not go so far either.
    walk.head(-first_normal);
    walk.pass(6);
    const float survival = walk.survival(1e-3f);
    EXPECT_LT(survival, 0.3f);
    EXPECT_GT(survival, 0);
    // Once it has survived that, it is expected to bring as much again.
    EXPECT_EQ(walk.survival(1e-3f), 1);
    EXPECT_EQ(begin(guide).survival(1), 1);
    // Wherever the guide is at home, a walk has more throughput left.
    EXPECT_FLOAT_EQ(begin(guide).survival(1e-5f), 1e-2f);
}

}  // namespace
}  // namespace wend
