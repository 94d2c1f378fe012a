#include <tests/sampling/verdicts.h>
#include <wend/sampling/sampler.h>

#include <gtest/gtest.h>

#include <vector>

namespace wend {
namespace {

constexpr SamplerKind kinds[] = {SamplerKind::sobol, SamplerKind::independent};

std::vector<float> numbers(Sampler sampler, int n) {
    std::vector<float> result;
    for (int i = 0; i < n; ++i) {
        result.push_back(sampler.uniform());
    }
    return result;
}

TEST(Sampler, NumbersDependOnNothingButTheirKeys) {
    for (const SamplerKind kind : kinds) {
        const std::vector<float> before = numbers(Sampler(kind, 1, 20, 300), 100);
        numbers(Sampler(kind, 1, 21, 300), 17);
        EXPECT_EQ(numbers(Sampler(kind, 1, 20, 300), 100), before);
        EXPECT_NE(numbers(Sampler(kind, 2, 20, 300), 100), before);
        EXPECT_NE(numbers(Sampler(kind, 1, 21, 300), 100), before);
        EXPECT_NE(numbers(Sampler(kind, 1, 20, 301), 100), before);
    }
}

TEST(Sampler, TrackingNumbersDoNotShiftTheOthers) {
    Sampler plain(SamplerKind::sobol, 1, 2, 3), tracking(SamplerKind::sobol, 1, 2, 3);
    for (int i = 0; i < 20; ++i) {
        for (int j = 0; j < i; ++j) {
            tracking.random().uniform();
        }
        EXPECT_EQ(plain.uniform2(), tracking.uniform2());
    }
}

TEST(Sampler, EveryDimensionIsUniformOverSamplesAndOverPixels) {
    // Beyond dimension 48 the sequence goes over to independent numbers.
    for (const SamplerKind kind : kinds) {
        for (const int dimension : {0, 1, 7, 47, 48, 60}) {
            test::Uniformity over_samples, over_pixels;
            for (std::uint32_t i = 0; i < 20000; ++i) {
                Sampler a(kind, 5, 77, i), b(kind, 5, i, 77);
                for (int skip = 0; skip < dimension; ++skip) {
                    a.uniform();
                    b.uniform();
                }
                over_samples.add(a.uniform2());
                over_pixels.add(b.uniform2());
            }
            EXPECT_GE(over_samples.p_value(), test::passing) << dimension;
            EXPECT_GE(over_pixels.p_value(), test::passing) << dimension;
        }
    }
}

TEST(Sampler, SuccessiveDimensionsAreUncorrelated) {
    for (const SamplerKind kind : kinds) {
        for (const int dimension : {0, 10, 46, 47, 48}) {
            test::Uniformity pairs;
            for (std::uint64_t pixel = 0; pixel < 100000; ++pixel) {
                Sampler sampler(kind, 6, pixel, 5);
                for (int skip = 0; skip < dimension; ++skip) {
                    sampler.uniform();
                }
                const float x = sampler.uniform();
                pairs.add(Vec2(x, sampler.uniform()));
            }
            EXPECT_GE(pairs.p_value(), test::passing) << dimension;
        }
    }
}

TEST(Sampler, SobolIntegratesASmoothFunctionBetter) {
    const auto error = [](SamplerKind kind) {
        Moments squares;
        for (std::uint64_t pixel = 0; pixel < 200; ++pixel) {
            double sum = 0;
            for (std::uint32_t i = 0; i < 64; ++i) {
                const Vec2 u = Sampler(kind, 9, pixel, i).uniform2();
                sum += u.x * u.y / 64;
            }
            squares.add((sum - 0.25) * (sum - 0.25));
        }
        return squares.mean();
    };
    EXPECT_LT(20 * error(SamplerKind::sobol), error(SamplerKind::independent));
}

}  // namespace
}  // namespace wend
