#include <tests/sampling/verdicts.h>
#include <wend/core/random.h>
#include <wend/film/filter.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
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

std::vector<Case> cases() {
    const auto gauss = [](double x) { return std::exp(-2 * x * x) - std::exp(-4.5); };
    return {{"box", Filter::box(0.5f, 0.5f), 0.5f, [](double) { return 1.0; }},
            {"triangle", Filter::triangle(2, 2), 2, [](double x) { return 2 - std::abs(x); }},
            {"gaussian", Filter::gaussian(1.5f, 1.5f, 0.5f), 1.5f, gauss},
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

TEST(Filter, WeightedMomentsAreTheFilters) {
    for (const Case& c : cases()) {
        Moments weight, x, x2, y2, x4;
        Pcg32 random(1);
        for (int i = 0; i < 1500000; ++i) {
            const auto s = c.filter.sample(random.uniform2());
            weight.add(s.weight);
            x.add(s.weight * s.offset.x);
            x2.add(s.weight * s.offset.x * s.offset.x);
            y2.add(s.weight * s.offset.y * s.offset.y);
            x4.add(s.weight * std::pow(s.offset.x, 4));
        }
        SCOPED_TRACE(c.name);
        EXPECT_TRUE(test::is_within_one_percent(weight, 1, 1e-4));
        EXPECT_TRUE(test::is_within_one_percent(x2, moment(c, 2), 1e-3));
        EXPECT_TRUE(test::is_within_one_percent(y2, moment(c, 2), 1e-3));
        EXPECT_TRUE(agrees(x4, moment(c, 4), 4, 2e-3));
        EXPECT_LT(std::abs(x.mean()), 4 * x.standard_error() + 1e-5);
    }
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
