// Adjoints of plane-parallel media for tests, and verdicts on the planar decisions that follow them.
#pragma once

#include <wend/medium/averaged_phase.h>
#include <wend/numeric/quadrature.h>
#include <wend/planar/decisions.h>
#include <wend/planar/discrete_ordinates.h>
#include <wend/stats/chi_square.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace wend::test {

/// A medium under a uniform white sky on one side, and how well its adjoint is known.
struct PlanarCase {
    std::string_view name;
    double albedo = 0.8;
    double g = 0;
    double thickness = std::numeric_limits<double>::infinity();
    double ior = 1;
    bool lit_at_far = false;
    int transients = 8;
    double noise = 0;  ///< each coefficient is multiplied by a number in 1 ± noise
};

PlanarSlab slab_of(const PlanarCase& planar_case);
/// Solved by discrete ordinates, disturbed, and made fit for sampling.
PlanarAdjoint adjoint_of(const PlanarCase& planar_case);
/// Multiplies every coefficient by a number in 1 ± noise.
void disturb(PlanarModes& modes, double noise, std::uint64_t seed);

/// Adaptive Gauss and Legendre's: the error is about `tolerance`, also where the integrand jumps.
template <class F>
double adaptive_integral(const F& f, double begin, double end, double tolerance, int depth = 0) {
    static const Quadrature rule = gauss_legendre(8);
    const auto gauss = [&](double a, double b) {
        double sum = 0;
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            sum += rule.weights[i] * f(a + rule.nodes[i] * (b - a));
        }
        return sum * (b - a);
    };
    const double middle = 0.5 * (begin + end);
    const double halves = gauss(begin, middle) + gauss(middle, end);
    if (depth >= 40 || !(std::abs(halves - gauss(begin, end)) >= tolerance)) {
        return halves;
    }
    return adaptive_integral(f, begin, middle, tolerance / 2, depth + 1) +
           adaptive_integral(f, middle, end, tolerance / 2, depth + 1);
}

/// What a decision is found to do at one place.
struct PlanarVerdict {
    double total = 0;         ///< integral of the claimed density over all outcomes
    double p_value = 0;       ///< of drawn samples, if the claimed density is theirs
    double disagreement = 0;  ///< largest relative difference between the boosts of sample() and density_ratio()
};

/// Counts of samples in cells between `edges` (the last one open) against integrals of a density over them. `rest` is
/// the probability of an outcome of its own, whose samples are infinite.
PlanarVerdict judge(const std::vector<double>& samples, const std::vector<double>& edges,
                    const std::vector<double>& probabilities, double rest);

/// Edges of cells that hold about as many of these samples each, from `begin` on.
std::vector<double> cell_edges(std::vector<double> samples, double begin);

/// Draws flights by one decision and judges them by the density of another, usually the same.
template <PlanarFlightDecision D>
PlanarVerdict judge_flights(const D& drawn, const D& claimed, double thickness, double depth, double mu,
                            std::uint64_t seed, int count = 20000) {
    typename D::Site drawn_from, from, to;
    drawn.at(depth, drawn_from);
    claimed.at(depth, from);
    const double length = mu > 0 ? (thickness - depth) / mu : depth / -mu;
    const auto density = [&](double s) {
        claimed.at(std::clamp(depth + s * mu, 0.0, thickness), to);
        return std::exp(-s) * claimed.density_ratio(from, mu, {true, s, 1}, to);
    };
    Pcg32 random(seed);
    std::vector<double> pilot;
    for (int i = 0; i < count / 4; ++i) {
        const PlanarFlight flight = claimed.sample(from, mu, random, to);
        if (flight.scatters) {
            pilot.push_back(flight.length);
        }
    }
    const std::vector<double> edges = cell_edges(std::move(pilot), 0);
    std::vector<double> probabilities;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        double sum = 0;
        if (i + 1 < edges.size()) {
            sum = adaptive_integral(density, edges[i], edges[i + 1], 1e-10);
        } else {
            // To the boundary, or until nothing is left, in panels that grow.
            double begin = edges[i], width = std::max(0.1 * begin, std::min(1e-3, length));
            double last = 1;
            while (begin < length && (last > 1e-12 || begin < 1)) {
                const double end = std::min(begin + width, length);
                last = adaptive_integral(density, begin, end, 1e-10);
                sum += last;
                begin = end;
                width *= 2;
            }
        }
        probabilities.push_back(sum);
    }
    const double boundary =
        std::isinf(length) ? 0 : std::exp(-length) * claimed.density_ratio(from, mu, {false, length, 1}, from);

    std::vector<double> samples;
    double disagreement = 0;
    for (int i = 0; i < count; ++i) {
        const PlanarFlight flight = drawn.sample(drawn_from, mu, random, to);
        samples.push_back(flight.scatters ? flight.length : std::numeric_limits<double>::infinity());
        const double again = drawn.density_ratio(drawn_from, mu, flight, to);
        disagreement = std::max(disagreement, std::abs(again / flight.density_ratio - 1));
    }
    PlanarVerdict verdict = judge(samples, edges, probabilities, boundary);
    verdict.disagreement = disagreement;
    return verdict;
}

/// The same for cosines after a collision.
template <PlanarDirectionDecision D>
PlanarVerdict judge_directions(const D& drawn, const D& claimed, double g, double depth, double before,
                               std::uint64_t seed, int count = 20000) {
    const auto density = [&](double after) {
        return averaged_henyey_greenstein(g, before, after) * claimed.density_ratio(depth, before, after);
    };
    Pcg32 random(seed);
    std::vector<double> pilot;
    for (int i = 0; i < count / 4; ++i) {
        pilot.push_back(claimed.sample(depth, before, random).cosine);
    }
    std::vector<double> edges = cell_edges(std::move(pilot), -1);
    edges.push_back(0);  // where a radiance may jump
    std::sort(edges.begin(), edges.end());
    std::vector<double> probabilities;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        probabilities.push_back(adaptive_integral(density, edges[i], i + 1 < edges.size() ? edges[i + 1] : 1.0, 1e-8));
    }
    std::vector<double> samples;
    double disagreement = 0;
    for (int i = 0; i < count; ++i) {
        const PlanarDirection direction = drawn.sample(depth, before, random);
        samples.push_back(direction.cosine);
        const double again = drawn.density_ratio(depth, before, direction.cosine);
        disagreement = std::max(disagreement, std::abs(again / direction.density_ratio - 1));
    }
    PlanarVerdict verdict = judge(samples, edges, probabilities, 0);
    verdict.disagreement = disagreement;
    return verdict;
}

}  // namespace wend::test
