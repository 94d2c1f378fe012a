#include <wend/planar/eigenvalue.h>

#include <wend/core/contracts.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace wend {
namespace {

/// atanh(k)/k - 1 without cancellation.
double atanh_excess(double k) {
    if (k > 0.3) {
        return std::atanh(k) / k - 1;
    }
    const double x = k * k;
    double sum = 0;
    for (int n = 18; n >= 1; --n) {
        sum = x * (1.0 / (2 * n + 1) + sum);
    }
    return sum;
}

/// For much scattering: solves atanh(k)/k - 1 = 1/albedo - 1 for k. The left side is convex, and the start is above the
/// root, so that Newton's method descends to it.
DiscreteEigenvalue solve_for_k(double albedo) {
    const double absorbed = 1 - albedo;
    const double excess = absorbed / albedo;
    double k = std::sqrt(3 * absorbed) * (1 - 0.4 * absorbed);
    for (int step = 0; step < 8 && k > 0; ++step) {
        const double value = atanh_excess(k);
        k -= (value - excess) * k / (k * k / (1 - k * k) - value);
    }
    return {k, 1 - k};
}

/// For little scattering: solves ln(gap / (2 - gap)) = -2 (1 - gap) / albedo for the logarithm of the gap.
DiscreteEigenvalue solve_for_gap(double albedo) {
    double gap = 2 * std::exp(-2 / albedo);
    for (int step = 0; step < 6 && gap > 0; ++step) {
        const double value = std::log(gap / (2 - gap)) + 2 * (1 - gap) / albedo;
        const double slope = 2 / (2 - gap) - 2 * gap / albedo;
        gap *= std::exp(-value / slope);
    }
    return {1 - gap, gap};
}

/// Without scattering moments from `first` on, the last pivot is first k Q_{first-1}(1/k) / Q_first(1/k), with
/// Legendre's functions of the second kind.
double last_pivot(std::size_t first, double k) {
    const double root = std::sqrt((1 - k) * (1 + k));
    const double decay = std::log((1 + root) / k);  // Q_n falls by exp(-decay) a degree, for large n
    const auto degree = static_cast<double>(first);
    if (degree * decay < 0.5) {
        // The recurrence runs upwards as long as the functions do not fall much.
        double before = std::atanh(k);
        double value = before / k - 1;
        for (double n = 1; n < degree; ++n) {
            const double next = ((2 * n + 1) / k * value - n * before) / (n + 1);
            before = value;
            value = next;
        }
        return degree * k * before / value;
    }
    const double last = degree + std::ceil(20 / decay);
    double pivot = (last + 0.5) * (1 + root);
    for (double n = last - 1; n >= degree; --n) {
        pivot = 2 * n + 1 - (n + 1) * (n + 1) * k * k / pivot;
    }
    return pivot;
}

/// The moments of radiance that decays as exp(-k x) solve a tridiagonal system with h_l = (2l + 1)(1 - albedo moment_l)
/// on the diagonal and (l + 1) k beside it. It is positive definite, that is, all pivots are positive, exactly for k
/// below the smallest root. Eliminated from its far end it leaves this pivot: no difference of large numbers even for
/// an albedo near 1, where 1 - albedo is compared with k²/(h_1 - ...).
double first_pivot(double albedo, std::span<const double> moments, double k) {
    double pivot = last_pivot(moments.size(), k);
    for (std::size_t l = moments.size(); l-- > 0;) {
        if (pivot <= 0) {
            return -1;
        }
        const auto n = static_cast<double>(l);
        pivot = (2 * n + 1) * (1 - albedo * moments[l]) - (n + 1) * (n + 1) * k * k / pivot;
    }
    return pivot;
}

}  // namespace

DiscreteEigenvalue discrete_eigenvalue(double albedo) {
    WEND_EXPECT(albedo >= 0 && albedo <= 1);
    return albedo > 0.5 ? solve_for_k(albedo) : solve_for_gap(albedo);
}

DiscreteEigenvalue discrete_eigenvalue(double albedo, std::span<const double> moments) {
    WEND_EXPECT(albedo >= 0 && albedo <= 1 && !moments.empty() && moments[0] == 1);
    if (albedo == 1) {
        return {0, 1};
    }
    const auto pivot = [&](double k) { return first_pivot(albedo, moments, k) / (1 - albedo); };
    double high = 1 - std::numeric_limits<double>::epsilon() / 2;
    if (pivot(high) > 0) {
        return {1, 0};
    }
    const double mean_cosine = moments.size() > 1 ? moments[1] : 0;
    // Diffusion theory is right for little absorption, where k is small; half of it is nearly always below the root.
    double low = std::min(0.5, 0.5 * std::sqrt(3 * (1 - albedo) * (1 - albedo * mean_cosine)));
    while (pivot(low) <= 0) {
        high = low;
        low /= 2;
    }
    std::uintmax_t steps = 200;
    const auto [below, above] =
        boost::math::tools::toms748_solve(pivot, low, high, boost::math::tools::eps_tolerance<double>(51), steps);
    const double k = below + (above - below) / 2;
    return {k, 1 - k};
}

DiscreteEigenvalue discrete_eigenvalue_henyey_greenstein(double albedo, double g) {
    WEND_EXPECT(std::abs(g) <= 0.99);
    std::vector<double> moments;
    for (double moment = 1; std::abs(moment) > 1e-18; moment *= g) {
        moments.push_back(moment);
    }
    return discrete_eigenvalue(albedo, moments);
}

}  // namespace wend
