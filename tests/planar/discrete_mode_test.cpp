#include <wend/medium/averaged_phase.h>
#include <wend/numeric/legendre.h>
#include <wend/planar/discrete_mode.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

std::vector<double> moments_of(double g) {
    std::vector<double> moments;
    for (double m = 1; std::abs(m) > 1e-14; m *= g) {
        moments.push_back(m);
    }
    return moments;
}

double source(const DiscreteMode& mode, double mu) {
    std::vector<double> p(mode.source.size());
    legendre_polynomials(mu, p);
    double sum = 0;
    for (std::size_t l = 0; l < p.size(); ++l) {
        sum += mode.source[l] * p[l];
    }
    return sum;
}

TEST(DiscreteMode, TheSourceIsTheRadianceConvolvedWithThePhaseFunction) {
    for (const double g : {0.0, 0.5, 0.8, 0.95, -0.5}) {
        for (const double albedo : {0.7, 0.95, 0.999}) {
            const DiscreteMode mode = discrete_mode(albedo, moments_of(g));
            for (const double before : {-0.9, -0.2, 0.5, 1.0}) {
                // Midpoints, dense where the phase function peaks.
                constexpr int n = 200000;
                double sum = 0;
                for (int i = 0; i < n; ++i) {
                    const double mu = -1 + (2 * i + 1.0) / n;
                    sum += averaged_henyey_greenstein(g, before, mu) * albedo * source(mode, mu) / (1 - mode.k * mu);
                }
                EXPECT_NEAR(sum * 2 / n, source(mode, before), 2e-5 * source(mode, before))
                    << "g " << g << " albedo " << albedo << " before " << before;
            }
        }
    }
}

TEST(DiscreteMode, AnotherAlbedoIsNoMode) {
    DiscreteMode mode = discrete_mode(0.95, moments_of(0.5));
    mode.k *= 1.05;
    double sum = 0;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
        const double mu = -1 + (2 * i + 1.0) / n;
        sum += averaged_henyey_greenstein(0.5, 0.5, mu) * mode.albedo * source(mode, mu) / (1 - mode.k * mu);
    }
    EXPECT_GT(std::abs(sum * 2 / n / source(mode, 0.5) - 1), 1e-3);
}

TEST(DiscreteMode, WithoutAbsorptionNothingDecays) {
    const DiscreteMode mode = discrete_mode(1, moments_of(0.8));
    EXPECT_EQ(mode.k, 0);
    EXPECT_EQ(mode.source, std::vector<double>{1});
}

}  // namespace
}  // namespace wend
