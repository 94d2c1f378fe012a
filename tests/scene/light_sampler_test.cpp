#include <tests/sampling/verdicts.h>
#include <wend/core/random.h>
#include <wend/core/vector.h>
#include <wend/sampling/warp.h>
#include <wend/scene/light_sampler.h>

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace wend {
namespace {

Vec3 point(Pcg32& random, float extent) {
    const auto one = [&] { return extent * (2 * random.uniform() - 1); };
    const float x = one(), y = one();
    return {x, y, one()};
}

/// Lights of all kinds, sizes and strengths, crowded enough that boxes overlap and receivers stand among them.
std::vector<Light> random_lights(std::uint64_t seed, int n) {
    Pcg32 random(seed);
    std::vector<Light> lights;
    for (int i = 0; i < n; ++i) {
        const Vec3 p = point(random, 3);
        const Rgb power(std::exp(4 * random.uniform() - 2));
        const bool flip = random.uniform() < 0.5f, two_sided = random.uniform() < 0.3f;
        const Vec3 a = point(random, 1), b = point(random, 1);
        const Transform place = Transform::translate(p.x, p.y, p.z) *
                                Transform::rotate(360 * random.uniform(), a.x, a.y, a.z) *
                                Transform::scale(0.2 + random.uniform(), 0.3, 0.1 + random.uniform());
        switch (i % 4) {
            case 0:
                lights.push_back(PointLight{p, power});
                break;
            case 1:
                lights.push_back(make_triangle_light(p, p + a, p + b, flip, power, two_sided));
                break;
            case 2:
                lights.push_back(
                    make_quadric_light(std::make_shared<Quadric>(Disk{}, place), place, flip, power, two_sided));
                break;
            default:
                lights.push_back(
                    make_quadric_light(std::make_shared<Quadric>(Sphere{}, place), place, flip, power, two_sided));
                break;
        }
    }
    return lights;
}

std::vector<LightReceiver> random_receivers(std::uint64_t seed, int n) {
    Pcg32 random(seed);
    std::vector<LightReceiver> receivers;
    for (int i = 0; i < n; ++i) {
        const Vec3 p = point(random, i % 3 == 0 ? 20.0f : 4.0f);
        receivers.push_back({p, i % 2 == 0 ? Vec3(0) : to_sphere(random.uniform2())});
    }
    return receivers;
}

template <class Sampler>
class LightSamplers : public testing::Test {};
using Kinds = testing::Types<PowerLightSampler, TreeLightSampler>;
TYPED_TEST_SUITE(LightSamplers, Kinds);

std::vector<Light> lights_with_sky(std::uint64_t seed) {
    std::vector<Light> lights = random_lights(seed, 23);
    lights.insert(lights.begin() + 5, UniformInfiniteLight{Rgb(0.01f)});
    lights.push_back(DistantLight{{0, 0, 1}, Rgb(0.1f)});
    return lights;
}

/// P-value of the frequencies of lights against probabilities; "none" has what they lack to 1.
template <class Sampler>
double p_value_of(const Sampler& sampler, const LightReceiver& receiver, std::vector<double> probabilities) {
    constexpr int samples = 50000;
    std::vector<std::uint64_t> observed(probabilities.size() + 1);
    Pcg32 random(1);
    for (int i = 0; i < samples; ++i) {
        const ChosenLight chosen = sampler.sample(receiver, random.uniform());
        ++(chosen.index < 0 ? observed.back() : observed[static_cast<std::size_t>(chosen.index)]);
    }
    const double missing = 1 - std::accumulate(probabilities.begin(), probabilities.end(), 0.0);
    probabilities.push_back(missing < 1e-5 ? 0 : missing);
    for (double& p : probabilities) {
        p *= samples;
    }
    return chi_square_test(observed, probabilities).p_value;
}

TYPED_TEST(LightSamplers, FrequenciesFitTheProbabilities) {
    for (const std::uint64_t seed : {1, 2}) {
        const std::vector<Light> lights = lights_with_sky(seed);
        const TypeParam sampler(lights, 5);
        for (const LightReceiver& receiver : random_receivers(seed, 12)) {
            std::vector<double> probabilities;
            for (int i = 0; i < static_cast<int>(lights.size()); ++i) {
                probabilities.push_back(sampler.probability(receiver, i));
            }
            EXPECT_LE(std::accumulate(probabilities.begin(), probabilities.end(), 0.0), 1 + 1e-5);
            EXPECT_GE(p_value_of(sampler, receiver, probabilities), 1e-4) << receiver.position << receiver.normal;
            std::rotate(probabilities.begin(), probabilities.begin() + 1, probabilities.end());
            EXPECT_LT(p_value_of(sampler, receiver, probabilities), test::failing);
        }
    }
}

TYPED_TEST(LightSamplers, SampleReportsTheProbability) {
    const std::vector<Light> lights = lights_with_sky(3);
    const TypeParam sampler(lights, 5);
    for (const LightReceiver& receiver : random_receivers(3, 50)) {
        for (int i = 0; i < 100; ++i) {
            const ChosenLight chosen = sampler.sample(receiver, (static_cast<float>(i) + 0.5f) / 100);
            if (chosen.index >= 0) {
                EXPECT_NEAR(chosen.probability, sampler.probability(receiver, chosen.index),
                            1e-5f * chosen.probability);
            }
        }
    }
}

TYPED_TEST(LightSamplers, WhateverShinesCanBeChosen) {
    Pcg32 random(4);
    for (std::uint64_t seed = 10; seed < 40; ++seed) {
        const std::vector<Light> lights = random_lights(seed, 1 + static_cast<int>(seed % 17));
        const TypeParam sampler(lights, 5);
        for (const LightReceiver& receiver : random_receivers(seed, 60)) {
            for (std::size_t i = 0; i < lights.size(); ++i) {
                bool shines = false;
                for (int k = 0; k < 20 && !shines; ++k) {
                    // The back of a surface counts: it may transmit.
                    const auto s = sample_light(lights[i], receiver.position, random.uniform2(), random);
                    shines = s && !is_black(s->radiance) &&
                             (length_squared(receiver.normal) == 0 || abs_dot(s->direction, receiver.normal) > 1e-3f);
                }
                if (shines) {
                    EXPECT_GT(sampler.probability(receiver, static_cast<int>(i)), 0)
                        << "light " << i << " of seed " << seed;
                }
            }
        }
    }
}

TYPED_TEST(LightSamplers, WithoutLightsThereIsNone) {
    const TypeParam sampler(std::span<const Light>{}, 1);
    EXPECT_LT(sampler.sample({}, 0.5f).index, 0);
}

TEST(PowerLightSampler, ProbabilitiesAreInProportionToPower) {
    const std::vector<Light> lights = {PointLight{{0, 0, 0}, Rgb(1)}, PointLight{{9, 0, 0}, Rgb(3)}};
    EXPECT_FLOAT_EQ(PowerLightSampler(lights, 1).probability({}, 1), 0.75f);
}

TEST(TreeLightSampler, PrefersWhatIsNearAndFaces) {
    const std::vector<Light> lights = {PointLight{{0, 0, 1}, Rgb(1)}, PointLight{{0, 0, 100}, Rgb(1)}};
    const TreeLightSampler sampler(lights, 1);
    EXPECT_GT(sampler.probability({{0, 0, 0}}, 0), 0.99f);
    EXPECT_GT(sampler.probability({{0, 0, 99}}, 1), 0.99f);
    // A light that faces away is never chosen.
    const std::vector<Light> facing = {make_triangle_light({0, 0, 1}, {1, 0, 1}, {0, 1, 1}, false, Rgb(1), false),
                                       make_triangle_light({3, 0, 1}, {4, 0, 1}, {3, 1, 1}, true, Rgb(1), false)};
    const TreeLightSampler oriented(facing, 1);
    EXPECT_EQ(oriented.probability({{0, 0, -5}}, 0), 0);
    EXPECT_EQ(oriented.probability({{0, 0, -5}}, 1), 1);
}

}  // namespace
}  // namespace wend
