#include <tests/support/planar.h>

namespace wend::test {

PlanarSlab slab_of(const PlanarCase& c) {
    PlanarSlab slab;
    slab.thickness = c.thickness;
    slab.near.ior = slab.far.ior = c.ior;
    (c.lit_at_far ? slab.far : slab.near).illumination = [](double /*cosine*/) { return 1.0; };
    return slab;
}

void disturb(PlanarModes& modes, double noise, std::uint64_t seed) {
    Pcg32 random(seed);
    for (PlanarModes::Mode& mode : modes.modes) {
        mode.near *= 1 + noise * (2 * random.uniform_double() - 1);
        mode.far *= 1 + noise * (2 * random.uniform_double() - 1);
        for (double& coefficient : mode.shape) {
            coefficient *= 1 + noise * (2 * random.uniform_double() - 1);
        }
    }
}

PlanarAdjoint adjoint_of(const PlanarCase& c) {
    PlanarProblem problem;
    problem.albedo = c.albedo;
    problem.moments = henyey_greenstein_moments(c.g, c.g == 0 ? 1 : 2 * (c.transients + 1));
    problem.slab = slab_of(c);
    problem.transients = c.transients;
    PlanarModes modes = solve_planar(problem);
    disturb(modes, c.noise, 5);
    PlanarAdjoint adjoint(modes, problem.slab);
    adjoint.keep_positive();
    return adjoint;
}

std::vector<double> cell_edges(std::vector<double> samples, double begin) {
    constexpr std::size_t cells = 40;
    std::sort(samples.begin(), samples.end());
    std::vector<double> edges = {begin};
    for (std::size_t i = 1; i < cells; ++i) {
        const std::size_t at = i * samples.size() / cells;
        if (at < samples.size() && samples[at] > edges.back()) {
            edges.push_back(samples[at]);
        }
    }
    return edges;
}

PlanarVerdict judge(const std::vector<double>& samples, const std::vector<double>& edges,
                    const std::vector<double>& probabilities, double rest) {
    std::vector<std::uint64_t> counts(edges.size() + 1);
    for (const double x : samples) {
        const auto cell = std::isinf(x) ? edges.end() : std::upper_bound(edges.begin(), edges.end(), x) - 1;
        ++counts[static_cast<std::size_t>(cell - edges.begin())];
    }
    PlanarVerdict verdict;
    verdict.total = rest;
    for (const double p : probabilities) {
        verdict.total += p;
    }
    std::vector<double> expected;
    const auto count = static_cast<double>(samples.size());
    for (const double p : probabilities) {
        expected.push_back(count * std::max(p, 0.0) / verdict.total);
    }
    expected.push_back(count * rest / verdict.total);
    const double largest = *std::max_element(expected.begin(), expected.end());
    if (count - largest < 20) {
        // Nearly always the same outcome: too few others for a chi-square test, but they may not be many.
        const auto at = static_cast<std::size_t>(std::max_element(expected.begin(), expected.end()) - expected.begin());
        verdict.p_value = count - static_cast<double>(counts[at]) < 60 ? 1 : 0;
    } else {
        verdict.p_value = chi_square_test(counts, expected).p_value;
    }
    return verdict;
}

}  // namespace wend::test
