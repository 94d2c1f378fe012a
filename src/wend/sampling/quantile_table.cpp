#include <wend/sampling/quantile_table.h>

#include <wend/core/contracts.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace wend {
namespace {

/// No density falls below this part of its row's mean.
constexpr double least_density = 1e-6;
/// Slopes up to this multiple of a cell's secant keep a cubic increasing (3 would let it rest; fritsch1980).
constexpr double steepest = 2.9;

/// Fractions dense at both ends: quadratic in the node's number towards either.
double fraction_of(double y) {
    return y < 0.5 ? 2 * y * y : 1 - 2 * (1 - y) * (1 - y);
}
double node_of(double fraction) {
    return fraction < 0.5 ? std::sqrt(0.5 * fraction) : 1 - std::sqrt(0.5 * (1 - fraction));
}

/// Places in a piece as a function of a parameter in [0,1], dense at both ends, and its derivative.
double place_of(double y) {
    return y * y * (3 - 2 * y);
}
double place_slope(double y) {
    return 6 * y * (1 - y);
}

/// The cubic through four neighbours of a regularly spaced sequence: its coefficients by powers of s, where s in [0,1]
/// runs from element i to i + 1.
std::array<double, 4> local_cubic(std::span<const double> f, std::size_t i) {
    const std::size_t n = f.size();
    // Beyond an end the sequence is continued by a parabola.
    const double b = f[i], c = f[i + 1];
    const double d = i + 2 < n ? f[i + 2] : 3 * c - 3 * b + f[i - 1];
    const double a = i > 0 ? f[i - 1] : 3 * b - 3 * c + d;
    return {b, -a / 3 - b / 2 + c - d / 6, (a + c) / 2 - b, (d - a) / 6 + (b - c) / 2};
}

double integral(const std::array<double, 4>& p, double s) {
    return s * (p[0] + s * (p[1] / 2 + s * (p[2] / 3 + s * p[3] / 4)));
}
double value(const std::array<double, 4>& p, double s) {
    return p[0] + s * (p[1] + s * (p[2] + s * p[3]));
}

/// Up to where in [0, 1] the integral of a cubic is `wanted`, of `whole` up to 1: bisection, with Newton's steps where
/// they stay inside.
double upper_limit(const std::array<double, 4>& p, double wanted, double whole) {
    double low = 0, high = 1, s = std::clamp(wanted / whole, 0.0, 1.0);
    for (int iteration = 0; iteration < 60; ++iteration) {
        const double error = integral(p, s) - wanted;
        (error > 0 ? high : low) = s;
        const double rise = value(p, s);
        const double newton = s - error / rise;
        const double next = rise > 0 && newton > low && newton < high ? newton : (low + high) / 2;
        if (std::abs(next - s) < 1e-12) {
            return next;
        }
        s = next;
    }
    return s;
}

}  // namespace

QuantileTable::QuantileTable(std::vector<double> breaks, int cells, int rows)
    : breaks_(std::move(breaks)), cells_(cells) {
    WEND_EXPECT(breaks_.size() >= 2 && cells >= 2 && cells % 2 == 0 && rows >= 1);
    for (int i = 0; i <= cells; ++i) {
        fraction_.push_back(fraction_of(static_cast<double>(i) / cells));
    }
    const auto count = static_cast<std::size_t>(rows) * static_cast<std::size_t>(pieces());
    probability_.resize(count);
    nodes_.resize(count * (static_cast<std::size_t>(cells) + 1));
    constexpr int resolution = 8;
    set_row(0, std::vector<double>(static_cast<std::size_t>(pieces() * resolution), 1.0), resolution);
    for (std::size_t row = 1; row < static_cast<std::size_t>(rows); ++row) {
        std::copy_n(probability_.begin(), pieces(), probability_.begin() + static_cast<std::ptrdiff_t>(row) * pieces());
        std::copy_n(nodes_.begin(), node_index(1, 0, 0),
                    nodes_.begin() + static_cast<std::ptrdiff_t>(node_index(static_cast<int>(row), 0, 0)));
    }
}

std::vector<double> QuantileTable::places(int piece, int resolution) const {
    const double begin = breaks_[static_cast<std::size_t>(piece)];
    const double end = breaks_[static_cast<std::size_t>(piece) + 1];
    std::vector<double> result;
    for (int i = 0; i < resolution; ++i) {
        result.push_back(begin + (end - begin) * place_of(static_cast<double>(i) / (resolution - 1)));
    }
    return result;
}

std::size_t QuantileTable::node_index(int row, int piece, int node) const {
    return (static_cast<std::size_t>(row) * static_cast<std::size_t>(pieces()) + static_cast<std::size_t>(piece)) *
               (static_cast<std::size_t>(cells_) + 1) +
           static_cast<std::size_t>(node);
}

void QuantileTable::set_row(int row, std::span<const double> densities, int resolution) {
    WEND_EXPECT(densities.size() == static_cast<std::size_t>(pieces() * resolution) && resolution >= 4);
    // The mean density over the interval, for the floor.
    double mass = 0;
    for (int piece = 0; piece < pieces(); ++piece) {
        const double width = breaks_[static_cast<std::size_t>(piece) + 1] - breaks_[static_cast<std::size_t>(piece)];
        for (int i = 0; i < resolution; ++i) {
            const double y = static_cast<double>(i) / (resolution - 1);
            mass += width * place_slope(y) / (resolution - 1) *
                    std::max(0.0, densities[static_cast<std::size_t>(piece * resolution + i)]);
        }
    }
    const double floor = mass > 0 ? least_density * mass / (breaks_.back() - breaks_.front()) : 1;

    double total = 0;
    std::vector<double> one(static_cast<std::size_t>(resolution));
    for (int piece = 0; piece < pieces(); ++piece) {
        for (std::size_t i = 0; i < one.size(); ++i) {
            one[i] = std::max(floor, densities[static_cast<std::size_t>(piece) * one.size() + i]);
        }
        set_piece(row, piece, one);
        total += probability_[static_cast<std::size_t>(row * pieces() + piece)];
    }
    for (int piece = 0; piece < pieces(); ++piece) {
        probability_[static_cast<std::size_t>(row * pieces() + piece)] /= total;
    }
}

// Finds the quantiles of one piece, and leaves its mass in probability_.
void QuantileTable::set_piece(int row, int piece, std::span<const double> densities) {
    const std::size_t n = densities.size();
    const double begin = breaks_[static_cast<std::size_t>(piece)];
    const double width = breaks_[static_cast<std::size_t>(piece) + 1] - begin;
    const double step = 1.0 / static_cast<double>(n - 1);
    std::vector<double> rate(n);  // density by the parameter
    std::vector<double> cumulative(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        rate[i] = densities[i] * place_slope(static_cast<double>(i) * step);
    }
    for (std::size_t i = 0; i + 1 < n; ++i) {
        const double cell = integral(local_cubic(rate, i), 1);
        cumulative[i + 1] = cumulative[i] + (cell > 0 ? cell : (rate[i] + rate[i + 1]) / 2);
    }
    const double total = cumulative.back();
    probability_[static_cast<std::size_t>(row * pieces() + piece)] = total * step * width;

    std::vector<double> quantile(fraction_.size()), slope(fraction_.size());
    std::size_t cell = 0;
    for (std::size_t j = 0; j < fraction_.size(); ++j) {
        const double target = fraction_[j] * total;
        while (cell + 2 < n && cumulative[cell + 1] < target) {
            ++cell;
        }
        const double wanted = std::min(target, cumulative[cell + 1]) - cumulative[cell];
        double s = upper_limit(local_cubic(rate, cell), wanted, cumulative[cell + 1] - cumulative[cell]);
        if (j == 0 || j + 1 == fraction_.size()) {
            s = j == 0 ? 0 : 1;
        }
        quantile[j] = begin + width * place_of((static_cast<double>(cell) + s) * step);
        const double density =
            std::max(value(local_cubic(densities, cell), s), 0.1 * std::min(densities[cell], densities[cell + 1]));
        slope[j] = total * step * width / density;
    }
    quantile.front() = begin;
    quantile.back() = begin + width;
    for (std::size_t j = 0; j < quantile.size(); ++j) {
        double limit = std::numeric_limits<double>::infinity();
        if (j > 0) {
            limit = std::min(limit, steepest * (quantile[j] - quantile[j - 1]) / (fraction_[j] - fraction_[j - 1]));
        }
        if (j + 1 < quantile.size()) {
            limit = std::min(limit, steepest * (quantile[j + 1] - quantile[j]) / (fraction_[j + 1] - fraction_[j]));
        }
        nodes_[node_index(row, piece, static_cast<int>(j))] = {quantile[j], std::min(slope[j], limit)};
    }
}

double QuantileTable::piece_probability(const Blend& blend, int piece) const {
    double sum = 0;
    for (int i = 0; i < blend.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        sum += blend.weight[k] * probability_[static_cast<std::size_t>(blend.row[k] * pieces() + piece)];
    }
    return sum;
}

QuantileTable::Cubic QuantileTable::cubic(const Blend& blend, int piece, int cell) const {
    Cubic c{};
    for (int i = 0; i < blend.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Node* node = &nodes_[node_index(blend.row[k], piece, cell)];
        c.value += blend.weight[k] * node[0].value;
        c.slope += blend.weight[k] * node[0].slope;
        c.end_value += blend.weight[k] * node[1].value;
        c.end_slope += blend.weight[k] * node[1].slope;
    }
    const auto k = static_cast<std::size_t>(cell);
    const double width = fraction_[k + 1] - fraction_[k];
    c.slope *= width;
    c.end_slope *= width;
    return c;
}

QuantileTable::Sample QuantileTable::Cubic::at(double s) const {
    const double rise = end_value - value;
    const double second = 3 * rise - 2 * slope - end_slope;
    const double third = slope + end_slope - 2 * rise;
    return {value + s * (slope + s * (second + s * third)), slope + s * (2 * second + 3 * s * third)};
}

QuantileTable::Sample QuantileTable::sample(const Blend& blend, double u) const {
    int piece = 0;
    double probability = piece_probability(blend, 0);
    while (piece + 1 < pieces() && u >= probability) {
        u -= probability;
        probability = piece_probability(blend, ++piece);
    }
    const double fraction = std::clamp(u / probability, 0.0, 1.0);
    int cell = std::clamp(static_cast<int>(node_of(fraction) * cells_), 0, cells_ - 1);
    // Rounding may have missed the cell by one.
    cell -= fraction < fraction_[static_cast<std::size_t>(cell)] ? 1 : 0;
    cell += cell + 1 < cells_ && fraction >= fraction_[static_cast<std::size_t>(cell) + 1] ? 1 : 0;
    const auto k = static_cast<std::size_t>(cell);
    const double width = fraction_[k + 1] - fraction_[k];
    const Sample drawn = cubic(blend, piece, cell).at((fraction - fraction_[k]) / width);
    return {drawn.value, probability * width / drawn.density};
}

double QuantileTable::density(const Blend& blend, double value) const {
    int piece = 0;
    while (piece + 1 < pieces() && value >= breaks_[static_cast<std::size_t>(piece) + 1]) {
        ++piece;
    }
    int low = 0, high = cells_;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        (cubic(blend, piece, middle).value <= value ? low : high) = middle;
    }
    const Cubic c = cubic(blend, piece, low);
    // Newton's steps where they stay inside; what a step leaves is about its square.
    constexpr double least_step = 1e-9;
    double begin = 0, end = 1, s = 0.5;
    for (int iteration = 0; iteration < 60 && end - begin > 1e-15; ++iteration) {
        const Sample at = c.at(s);
        (at.value > value ? end : begin) = s;
        const double newton = s - (at.value - value) / at.density;
        if (std::abs(newton - s) < least_step) {
            s = std::clamp(newton, begin, end);
            break;
        }
        s = newton > begin && newton < end ? newton : (begin + end) / 2;
    }
    const auto k = static_cast<std::size_t>(low);
    return piece_probability(blend, piece) * (fraction_[k + 1] - fraction_[k]) / c.at(s).density;
}

}  // namespace wend
