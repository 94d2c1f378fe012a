#include <wend/stats/chi_square.h>

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

namespace wend {
namespace {

constexpr double smallest_expected_count = 5;

struct Cell {
    double observed = 0, expected = 0;

    double deviation() const { return (observed - expected) * (observed - expected) / expected; }
};

std::vector<Cell> cells_by_expected_count(std::span<const std::uint64_t> observed, std::span<const double> expected) {
    if (observed.size() != expected.size()) {
        throw std::invalid_argument("chi_square_test: observed and expected counts differ in number");
    }
    std::vector<Cell> cells;
    cells.reserve(observed.size());
    for (std::size_t i = 0; i < observed.size(); ++i) {
        if (!(expected[i] >= 0 && std::isfinite(expected[i]))) {
            throw std::invalid_argument("chi_square_test: an expected count is negative or not finite");
        }
        cells.push_back({static_cast<double>(observed[i]), expected[i]});
    }
    std::stable_sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.expected < b.expected; });
    return cells;
}

}  // namespace

ChiSquare chi_square_test(std::span<const std::uint64_t> observed, std::span<const double> expected) {
    Cell pool;
    int cells_left = 0;
    bool impossible = false;
    double statistic = 0;
    for (const Cell& cell : cells_by_expected_count(observed, expected)) {
        if (cell.expected == 0) {
            impossible |= cell.observed > 0;
        } else if (cell.expected < smallest_expected_count ||
                   (pool.expected > 0 && pool.expected < smallest_expected_count)) {
            pool.observed += cell.observed;
            pool.expected += cell.expected;
        } else {
            statistic += cell.deviation();
            ++cells_left;
        }
    }
    if (pool.expected > 0) {
        statistic += pool.deviation();
        ++cells_left;
    }
    const int degrees_of_freedom = cells_left - 1;
    if (impossible) {
        return {std::numeric_limits<double>::infinity(), degrees_of_freedom, 0.0};
    }
    if (degrees_of_freedom < 1) {
        throw std::invalid_argument("chi_square_test: fewer than two cells expect enough counts");
    }
    return {statistic, degrees_of_freedom, chi_square_p_value(statistic, degrees_of_freedom)};
}

double chi_square_p_value(double statistic, int degrees_of_freedom) {
    return boost::math::gamma_q(0.5 * degrees_of_freedom, 0.5 * statistic);
}

}  // namespace wend
