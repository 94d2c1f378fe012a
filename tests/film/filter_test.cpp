#include <wend/core/random.h>
#include <wend/film/filter.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace wend {
namespace {

/// A filter with one axis of it as its definition says.
struct Case {
    std::string name;
    Filter filter;
    float radius;
    std::function<double(double)> value;
};

/// Mitchell and Netravali's cubic over [-2, 2], b = c = 1/3.
double mitchell(double x) {
    x = std::abs(x);
    return x < 1 ? (7 * x * x * x - 12 * x * x + 16.0 / 3) / 6
                 : (-7.0 / 3 * x * x * x + 12 * x * x - 20 * x + 32.0 / 3) / 6;
}

/// Windowed over tau lobes.
double sinc(double x, double tau) {
    const double angle = x * std::numbers::pi;
    return std::sin(angle) / angle * std::sin(angle / tau) / (angle / tau);
}

std::vector<Case> cases() {
    const auto gauss = [](double x) { return std::exp(-2 * x * x) - std::exp(-4.5); };
    return {{"box", Filter::box(0.5f, 0.5f), 0.5f, [](double) { return 1.0; }},
            {"triangle", Filter::triangle(2, 2), 2, [](double x) { return 2 - std::abs(x); }},
            {"gaussian", Filter::gaussian(1.5f, 1.5f, 0.5f), 1.5f, gauss},
            {"sinc", Filter::sinc(4, 4, 3), 4, [](double x) { return sinc(x, 3); }},
            {"sinc_narrow", Filter::sinc(1.5f, 1.5f, 2), 1.5f, [](double x) { return sinc(x, 2); }},
            {"mitchell", Filter::mitchell(2, 2), 2, mitchell},
            {"mitchell_narrow", Filter::mitchell(1, 1), 1, [](double x) { return mitchell(2 * x); }}};
}

/// Σ f(x) x^power / Σ f(x)
double moment(const Case& c, int power) {
    constexpr int steps = 100000;
    double sum = 0, total = 0;
    for (int i = 0; i < steps; ++i) {
        const double x = c.radius * (2 * (i + 0.5) / steps - 1);
        sum += c.value(x) * std::pow(x, power);
        total += c.value(x);
    }
    return sum / total;
}

/// Mean of weight · offset^power over a fine lattice of uniform numbers for one axis (0: x), the other's at 1/2.
double weighted_moment(const Filter& filter, int axis, int power) {
    constexpr int n = 200000;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        Vec2 u(0.5f);
        u[axis] = (static_cast<float>(i) + 0.5f) / n;
        const auto s = filter.sample(u);
        sum += s.weight * std::pow(s.offset[axis], power);
    }
    return sum / n;
}

TEST(Filter, WeightedMomentsAreTheFilters) {
    for (const Case& c : cases()) {
        SCOPED_TRACE(c.name);
        const double along_x = weighted_moment(c.filter, 0, 0), along_y = weighted_moment(c.filter, 1, 0);
        // Weights are products over the axes.
        EXPECT_NEAR(along_x * along_y / c.filter.sample(Vec2(0.5f)).weight, 1, 1e-4);
        for (const int axis : {0, 1}) {
            const double weight = axis == 0 ? along_x : along_y;
            EXPECT_NEAR(weighted_moment(c.filter, axis, 1) / weight, 0, 1e-4 * c.radius);
            EXPECT_NEAR(weighted_moment(c.filter, axis, 2) / weight, moment(c, 2), 2e-3 * moment(c, 2));
            EXPECT_NEAR(weighted_moment(c.filter, axis, 4) / weight, moment(c, 4), 5e-3 * std::abs(moment(c, 4)));
        }
    }
}

TEST(Filter, AGaussianOfAnotherWidthIsTold) {
    const double variance = weighted_moment(Filter::gaussian(1.5f, 1.5f, 0.505f), 0, 2);
    EXPECT_GT(std::abs(variance - moment(cases()[2], 2)), 2e-3 * variance);
}

TEST(Filter, PositiveFiltersHaveUnitWeights) {
    Pcg32 random(2);
    for (const Filter& filter : {Filter::box(), Filter::triangle(), Filter::gaussian()}) {
        for (int i = 0; i < 1000; ++i) {
            EXPECT_FLOAT_EQ(filter.sample(random.uniform2()).weight, 1);
        }
    }
}

TEST(Filter, OffsetsStayWithinTheRadii) {
    Pcg32 random(3);
    const Filter filter = Filter::gaussian(1, 3, 0.8f);
    float widest = 0, highest = 0;
    for (int i = 0; i < 100000; ++i) {
        const Vec2 offset = filter.sample(random.uniform2()).offset;
        widest = std::max(widest, std::abs(offset.x));
        highest = std::max(highest, std::abs(offset.y));
    }
    EXPECT_LE(widest, 1);
    EXPECT_LE(highest, 3);
    EXPECT_GT(highest, 2);
    EXPECT_LE(std::abs(filter.sample({0, one_minus_epsilon}).offset.x), 1);
}

}  // namespace
}  // namespace wend
