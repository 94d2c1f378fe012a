#include <tests/sampling/verdicts.h>
#include <wend/core/random.h>
#include <wend/numeric/quadrature.h>
#include <wend/sampling/quantile_table.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace wend {
namespace {

using Density = std::function<double(double)>;
using Blend = QuantileTable::Blend;

constexpr int resolution = 512;
constexpr double largest_u = 1 - 0x1p-53;

double constant(double /*x*/) {
    return 2;
}
double slope(double x) {
    return 1 + x;  // 0 at the left end
}
double peak(double x) {
    return std::exp(-0.5 * std::pow((x - 0.3) / 0.005, 2)) + 1e-3;
}
double jump(double x) {
    return x < 0 ? 0.1 : 1 + x;
}
double tail(double x) {
    return std::exp(-12 * (x + 1));
}
double singular(double x) {
    return std::sqrt(1 + x) * (x < 0 ? 1 : std::sqrt(x));
}
double nothing_left(double x) {
    return x < 0 ? 0 : 1;
}
const std::vector<Density> shapes = {constant, slope, peak, jump, tail, singular, nothing_left};

QuantileTable table_of(const std::vector<Density>& rows, int cells = 64) {
    QuantileTable table({-1, 0, 1}, cells, static_cast<int>(rows.size()));
    for (std::size_t row = 0; row < rows.size(); ++row) {
        std::vector<double> densities;
        for (int piece = 0; piece < table.pieces(); ++piece) {
            std::vector<double> places = table.places(piece, resolution);
            places.front() += 1e-12;  // each piece sees its own side of a jump
            places.back() -= 1e-12;
            for (const double x : places) {
                densities.push_back(rows[row](x));
            }
        }
        table.set_row(static_cast<int>(row), densities, resolution);
    }
    return table;
}

double integral(const Density& f, double begin, double end) {
    const int panels = 400;
    static const Quadrature rule = gauss_legendre(8);
    double sum = 0;
    for (int i = 0; i < panels; ++i) {
        for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
            const double x = begin + (end - begin) * (i + rule.nodes[j]) / panels;
            sum += rule.weights[j] * f(x) * (end - begin) / panels;
        }
    }
    return sum;
}

/// Rows and mixtures of them: at most four.
std::vector<Blend> blends(int rows) {
    std::vector<Blend> result;
    for (int row = 0; row < rows; ++row) {
        result.push_back({{row}, {1}, 1});
    }
    result.push_back({{0, 1}, {0.3, 0.7}, 2});
    result.push_back({{1, 2, 3, 4}, {0.4, 0.1, 0.2, 0.3}, 4});
    return result;
}

/// P-value of samples of `drawn` against the density of `claimed`, counted in 50 cells.
double p_value(const QuantileTable& table, const Blend& drawn, const Blend& claimed) {
    constexpr int samples = 100000, cells = 50;
    std::vector<std::uint64_t> observed(cells);
    Pcg32 random(5);
    for (int i = 0; i < samples; ++i) {
        const double x = table.sample(drawn, random.uniform_double()).value;
        ++observed[static_cast<std::size_t>(std::min((x + 1) / 2 * cells, cells - 1.0))];
    }
    std::vector<double> expected;
    double total = 0;
    for (int i = 0; i < cells; ++i) {
        expected.push_back(integral([&](double x) { return table.density(claimed, x); }, -1 + 2.0 * i / cells,
                                    -1 + 2.0 * (i + 1) / cells));
        total += expected.back();
    }
    for (double& e : expected) {
        e *= samples / total;
    }
    return chi_square_test(observed, expected).p_value;
}

TEST(QuantileTable, DensitiesIntegrateToOne) {
    const QuantileTable table = table_of(shapes);
    for (const Blend& blend : blends(static_cast<int>(shapes.size()))) {
        const Density density = [&](double x) { return table.density(blend, x); };
        EXPECT_NEAR(integral(density, -1, 0) + integral(density, 0, 1), 1, 2e-4) << "row " << blend.row[0];
    }
}

TEST(QuantileTable, SamplesFollowTheDensity) {
    const QuantileTable table = table_of(shapes);
    for (const Blend& blend : blends(static_cast<int>(shapes.size()))) {
        EXPECT_GE(p_value(table, blend, blend), test::passing) << "row " << blend.row[0] << ", of " << blend.count;
    }
}

TEST(QuantileTable, TheDensityOfAnotherRowIsRejected) {
    // Their slopes differ by a tenth.
    const QuantileTable table = table_of({slope, [](double x) { return 1 + 0.9 * x; }});
    EXPECT_LT(p_value(table, {{0}, {1}, 1}, {{1}, {1}, 1}), test::failing);
}

TEST(QuantileTable, ApproximateWhatTheyWereGiven) {
    const QuantileTable table = table_of({slope, peak, jump, tail, singular}, 256);
    const std::vector<double> totals = {2, 0.005 * std::sqrt(2 * std::acos(-1.0)) + 2e-3, 1.6, (1 - std::exp(-24)) / 12,
                                        2.0 / 3 + integral(singular, 0, 1)};
    const std::vector<Density> given = {slope, peak, jump, tail, singular};
    for (std::size_t row = 0; row < given.size(); ++row) {
        for (const double x : {-0.99, -0.7, -0.2, 0.05, 0.297, 0.31, 0.8, 0.97}) {
            const double expected = given[row](x) / totals[row];
            EXPECT_NEAR(table.density({{static_cast<int>(row)}, {1}, 1}, x), expected, 0.01 * expected + 5e-4)
                << "row " << row << " at " << x;
        }
    }
}

TEST(QuantileTable, SamplesKnowTheirDensity) {
    const QuantileTable table = table_of(shapes);
    Pcg32 random(1);
    for (const Blend& blend : blends(static_cast<int>(shapes.size()))) {
        for (int i = 0; i < 2000; ++i) {
            const QuantileTable::Sample s = table.sample(blend, random.uniform_double());
            EXPECT_NEAR(table.density(blend, s.value) / s.density, 1, 1e-9) << "row " << blend.row[0] << " " << s.value;
        }
    }
}

TEST(QuantileTable, ValuesIncreaseAndStayInside) {
    const QuantileTable table = table_of(shapes);
    for (const Blend& blend : blends(static_cast<int>(shapes.size()))) {
        double before = -1;
        for (int i = 0; i <= 20000; ++i) {
            const QuantileTable::Sample s = table.sample(blend, i == 20000 ? largest_u : i / 20000.0);
            EXPECT_GE(s.value, before);
            EXPECT_GT(s.density, 0);
            before = s.value;
        }
        EXPECT_EQ(table.sample(blend, 0).value, -1);
        EXPECT_LE(before, 1);
        EXPECT_GT(before, 0.99);
    }
}

TEST(QuantileTable, StandExtremeDensities) {
    const std::vector<Density> extremes = {[](double /*x*/) { return 0.0; },
                                           [](double /*x*/) { return -1.0; },
                                           [](double x) { return std::abs(x - 0.5) < 0.01 ? 1e30 : 0; },
                                           [](double x) { return std::abs(x - 0.5) < 0.01 ? 1 : 1e-30; },
                                           [](double /*x*/) { return 1e-300; },
                                           [](double x) { return std::exp(-600 * (x + 1)); }};
    const QuantileTable table = table_of(extremes);
    for (const Blend& blend : blends(static_cast<int>(extremes.size()))) {
        for (const double u : {0.0, 1e-300, 1e-17, 0.2, 0.5, 0.999999, largest_u}) {
            const QuantileTable::Sample s = table.sample(blend, u);
            EXPECT_TRUE(s.value >= -1 && s.value <= 1) << "row " << blend.row[0] << ", u " << u;
            EXPECT_TRUE(s.density > 0 && std::isfinite(s.density)) << "row " << blend.row[0] << ", u " << u;
        }
        for (const double x : {-1.0, -1e-300, 0.0, 0.5, 1.0}) {
            const double density = table.density(blend, x);
            EXPECT_TRUE(density > 0 && std::isfinite(density)) << "row " << blend.row[0] << " at " << x;
        }
    }
    // Without densities all values are equally likely.
    EXPECT_NEAR(table.density({{0}, {1}, 1}, 0.3), 0.5, 1e-6);
    EXPECT_NEAR(table.density({{1}, {1}, 1}, -0.8), 0.5, 1e-6);
}

}  // namespace
}  // namespace wend
