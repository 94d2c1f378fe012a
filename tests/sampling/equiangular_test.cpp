// Distances towards a light beside a ray.
#include <tests/sampling/verdicts.h>
#include <wend/core/random.h>
#include <wend/decision/flight_pieces.h>
#include <wend/numeric/quadrature.h>

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <vector>

namespace wend {
namespace {

const Ray ray{{1, 2, 3}, normalize(Vec3(1, -2, 0.5f))};
const Vec3 across = normalize(cross(ray.direction, Vec3(0, 0, 1)));

struct Case {
    const char* name;
    float along, beside;  ///< where the light is
    float extent_squared;
    float t_in, t_out;

    Vec3 light() const { return ray.at(along) + across * beside; }
    ClosestApproach approach() const { return {ray, light(), extent_squared}; }
    Equiangular distances() const { return {approach(), t_in, t_out}; }
    friend void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
};

class EquiangularCases : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Lights, EquiangularCases,
                         testing::Values(Case{"within", 2, 0.3f, 0, 0.5f, 4}, Case{"close", 2, 0.01f, 0, 0, 4},
                                         Case{"before", -1, 0.5f, 0, 0, 3}, Case{"behind", 5, 0.2f, 0, 1, 3},
                                         Case{"extended", 2, 0, 0.04f, 0, 4}, Case{"far", 1, 100, 0, 0.2f, 0.9f},
                                         Case{"endless", 2, 0.3f, 0, 1, infinity}),
                         [](const auto& instance) { return std::string(instance.param.name); });

double square_of_distance(const Case& c, double t) {
    return std::pow(t - static_cast<double>(c.along), 2) + std::pow(static_cast<double>(c.beside), 2) +
           static_cast<double>(c.extent_squared);
}

/// ∫ f dt over the interval, in steps that are short where the light is close.
template <class F>
double integral_over(const Case& c, const F& f) {
    static const Quadrature rule = gauss_legendre(16);
    const double end = std::min(c.t_out, 1e6f);
    double sum = 0;
    for (double t = c.t_in; t < end;) {
        const double step = std::min(end - t, 0.3 * std::sqrt(square_of_distance(c, t)));
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            sum += step * rule.weights[i] * f(t + step * rule.nodes[i]);
        }
        t += step;
    }
    return sum;
}

TEST_P(EquiangularCases, TheDensityIsOneInTotal) {
    const Equiangular distances = GetParam().distances();
    EXPECT_NEAR(integral_over(GetParam(), [&](double t) { return distances.density(static_cast<float>(t)); }), 1, 1e-3);
}

TEST_P(EquiangularCases, TheIntegralIsThatOfInverseSquares) {
    const double expected = integral_over(GetParam(), [](double t) { return 1 / square_of_distance(GetParam(), t); });
    EXPECT_NEAR(GetParam().distances().integral(), expected, 2e-3 * expected);
}

TEST_P(EquiangularCases, SamplesHaveTheDensity) {
    const Case& c = GetParam();
    const Equiangular distances = c.distances();
    // Seen from the light, angles are uniform.
    const double width = std::sqrt(square_of_distance(c, c.along)),
                 begin = std::atan((static_cast<double>(c.t_in) - static_cast<double>(c.along)) / width),
                 end = std::atan((static_cast<double>(c.t_out) - static_cast<double>(c.along)) / width);
    Pcg32 random(1);
    test::Uniformity uniformity;
    for (int i = 0; i < 100000; ++i) {
        const float t = distances.sample(random.uniform());
        ASSERT_GE(t, c.t_in);
        ASSERT_LE(t, c.t_out);
        ASSERT_GT(distances.density(t), 0);
        uniformity.add((std::atan((static_cast<double>(t) - static_cast<double>(c.along)) / width) - begin) /
                       (end - begin));
    }
    EXPECT_GE(uniformity.p_value(), test::passing);
}

TEST_P(EquiangularCases, NothingIsDrawnOutside) {
    const Equiangular distances = GetParam().distances();
    EXPECT_EQ(distances.density(GetParam().t_in - 0.01f), 0);
    if (GetParam().t_out < infinity) {
        EXPECT_EQ(distances.density(GetParam().t_out + 0.01f), 0);
    }
}

TEST_P(EquiangularCases, TheCosineIsThatInTheMiddleOfTheAngle) {
    const Case& c = GetParam();
    const float t = c.distances().sample(0.5f);
    const float expected = (c.along - t) / static_cast<float>(std::sqrt(square_of_distance(c, t)));
    EXPECT_NEAR(c.distances().cosine(), expected, 2e-3f);
}

TEST_P(EquiangularCases, TheApproachKnowsDistanceAndCosine) {
    const Case& c = GetParam();
    for (const float t : {c.t_in, 0.3f, 1.7f}) {
        const double square = square_of_distance(c, t);
        EXPECT_NEAR(c.approach().squared_distance(t), square, 1e-5 * square + 1e-6);
        EXPECT_NEAR(c.approach().cosine(t), (c.along - t) / static_cast<float>(std::sqrt(square)), 1e-4f);
    }
}

TEST(ClosestApproach, WhereTheLightIsAboutAsFarItsMeanIsKnown) {
    int even = 0;
    Pcg32 random(3);
    for (int i = 0; i < 10000; ++i) {
        const float t_in = 4 * random.uniform();
        const Case c{"", 4 * random.uniform(), random.uniform(), 0.01f, t_in, t_in + 2 * random.uniform() + 0.01f};
        const ClosestApproach approach = c.approach();
        double nearest = infinity, farthest = 0;
        for (int step = 0; step <= 100; ++step) {
            const double square = square_of_distance(c, c.t_in + 0.01f * static_cast<float>(step) * (c.t_out - c.t_in));
            nearest = std::min(nearest, square);
            farthest = std::max(farthest, square);
        }
        if (farthest > 4.1 * nearest) {
            EXPECT_FALSE(approach.is_about_as_far(c.t_in, c.t_out)) << i;
        } else if (farthest < 3.9 * nearest) {
            EXPECT_TRUE(approach.is_about_as_far(c.t_in, c.t_out)) << i;
            const float mean = c.distances().integral() / (c.t_out - c.t_in);
            EXPECT_NEAR(approach.mean_inverse_square(c.t_in, c.t_out), mean, 0.26f * mean) << i;
            ++even;
        }
    }
    EXPECT_GT(even, 1000);
    EXPECT_LT(even, 9000);
    EXPECT_FALSE(ClosestApproach(ray, ray.at(1), 0.1f).is_about_as_far(0, infinity));
}

TEST(Equiangular, ALightOnTheRayOrAtItsOriginIsSurvived) {
    for (const float along : {0.0f, 1.0f}) {
        const Equiangular distances(ClosestApproach(ray, ray.at(along), 0), 0, 2);
        Pcg32 random(2);
        for (int i = 0; i < 1000; ++i) {
            const float t = distances.sample(random.uniform());
            ASSERT_TRUE(t >= 0 && t <= 2) << t;
            ASSERT_TRUE(std::isfinite(distances.density(t))) << t;
        }
        EXPECT_TRUE(std::isfinite(distances.integral()));
        EXPECT_TRUE(std::isfinite(distances.cosine()));
    }
}

}  // namespace
}  // namespace wend
